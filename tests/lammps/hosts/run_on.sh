#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Runs a command of ./run on another Debian with the LAMMPS that it has; the demo with few steps and little optimisation.
#   run_on.sh SUITE WORD...   trixie or sid; for example: run_on.sh trixie demo, run_on.sh trixie test "^lammps"
#   LSDCD_HOSTS               where the Debian is kept (default ${XDG_CACHE_HOME:-~/.cache}/lsdcd/hosts), as SUITE-root;
#                             1.5 GB with all that the demo installs, 3 GB with the tests
# What the command wrote is in SUITE-root/root/lsdcd, and its output in SUITE-root/root/run.log. The Debian comes from
# the mirror that this machine's apt uses. Exits 77 with a line "skipped: ..." where it cannot be had or entered.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
. "$top/tests/lammps/hosts/debian_mirror.sh"
suite=$1
shift
hosts=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}
debian=$hosts/$suite-root

skip() { echo "skipped: no Debian $suite: $*"; exit 77; }
debian_root "$suite" "$debian"

# What is in the tree, without what was built.
rm -rf "$debian/root/lsdcd"
mkdir -p "$debian/root/lsdcd"
cd "$top"
{ git ls-files -z --cached --others --exclude-standard 2>/dev/null ||
  find . \( -path './build*' -o -path ./demo \) -prune -o -type f -print0; } |
  tar -c --null --files-from=- --ignore-failed-read | tar -x -C "$debian/root/lsdcd"
if [ -e /etc/resolv.conf ]; then cp -L /etc/resolv.conf "$debian/etc/resolv.conf"; fi

# Mounts are seen by these commands only, and end with them.
status=0
unshare --mount --fork bash -euc '
  root=$0
  mount -t proc proc "$root/proc"
  mount -t sysfs sys "$root/sys"
  mount --rbind /dev "$root/dev"
  exec chroot "$root" env -i HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin LSDCD_QUICK=1 /root/lsdcd/run "$@"
' "$debian" "$@" 2>&1 </dev/null | tee "$debian/root/run.log" || status=$?
if grep -q '^./run: could not install' "$debian/root/run.log"; then skip "its packages cannot be installed"; fi
if [ "$1" != demo ]; then exit "$status"; fi

demo=$debian/root/lsdcd/demo
fact() { if "${@:2}"; then echo "PASS $1"; else echo "FAIL $1"; status=1; fi; }
fact "the demo ends well" test "$status" -eq 0
fact "it leaves a picture" grep -q PNG "$demo/vessel.png"
fact "it leaves its table" grep -q 'left through the outlet' "$demo/summary.txt"
exit "$status"
