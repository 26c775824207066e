#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Installs the packages in a clean Debian and uses them there.
#   packages_on.sh SUITE PACKAGES    bookworm or trixie; the folder with *.deb
#   LSDCD_HOSTS    where the Debian is kept, as SUITE-clean, some 300 MB; what is installed on top of
#                  it is in memory, and goes when this ends
# The packages are those of this machine's Debian: the library, tool and Python module are to install on
# a newer one, too, the LAMMPS plugin is to refuse another LAMMPS. Exits 77 with a line "skipped: ..."
# where the Debian cannot be had or entered.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$top/tests/lammps/hosts/debian_mirror.sh"
suite=$1 packages=$2
hosts=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}
skip() { echo "skipped: no packages on $suite: $*"; exit 77; }
ls "$packages"/*.deb >/dev/null
here=$(. /etc/os-release; echo "${VERSION_CODENAME:-}")
if [ "$here" != bookworm ] && [ "$here" != "$suite" ]; then skip "they are made on $here"; fi
debian_root "$suite" "$hosts/$suite-clean"

status=0
report=$(mktemp)
trap 'rm -f "$report"' EXIT
# Mounts are seen by these commands only, and end with them.
unshare --mount --fork bash -euc '
  root=$0 packages=$1 top=$2 script=$3 same=$4
  work=$(mktemp -d)
  mount -t tmpfs -o size=3g tmpfs "$work"
  mkdir "$work/upper" "$work/work" "$work/root"
  mount -t overlay -o "lowerdir=$root,upperdir=$work/upper,workdir=$work/work" overlay "$work/root"
  root=$work/root
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mkdir "$root/packages"
  cp "$packages"/*.deb "$root/packages"
  cp -r "$top/examples/library" "$root/examples"
  cp "$top/examples/piston/die.stl" "$script" "$root/examples"
  if [ -e /etc/resolv.conf ]; then cp -L /etc/resolv.conf "$root/etc/resolv.conf"; fi
  exec chroot "$root" env -i HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    DEBIAN_FRONTEND=noninteractive bash /examples/use_packages.sh "$same"
' "$hosts/$suite-clean" "$packages" "$top" "$top/tests/library/use_packages.sh" \
  "$([ "$suite" = "$here" ] && echo same || echo newer)" >"$report" 2>&1 </dev/null || status=$?
cat "$report"
if grep -q '^no packages from the mirror' "$report"; then skip "its own packages cannot be installed"; fi
exit "$status"
