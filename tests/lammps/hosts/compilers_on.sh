#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Lets g++ and clang of another Debian read all sources, against the LAMMPS that it has, and prints their warnings.
#   compilers_on.sh SUITE [PATTERN]   trixie or sid; PATTERN: only sources whose path has a match, for example "^src/"
#   LSDCD_HOSTS      where the Debian is kept (default ${XDG_CACHE_HOME:-~/.cache}/lsdcd/hosts), as SUITE-root, which
#                    run_on.sh uses, too; some 2 GB with both compilers
#   LSDCD_COMPILERS  which compilers (default: "g++ clang++")
#   LSDCD_HOST_JOBS  compilers at once (default: one per core)
# The Debian comes from the mirror that this machine's apt uses. Exits 77 with a line "skipped: ..." where it cannot be
# had or entered, and 1 where there is a warning.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
. "$top/tests/lammps/hosts/debian_mirror.sh"
suite=$1 pattern=${2:-}
debian=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}/$suite-root

skip() { echo "skipped: no compilers of $suite: $*"; exit 77; }
debian_root "$suite" "$debian"
if [ -e /etc/resolv.conf ]; then cp -L /etc/resolv.conf "$debian/etc/resolv.conf"; fi
mkdir -p "$debian/root/sources"

# Mounts are seen by these commands only, and end with them. The sources are read where they are; build folders are
# the other Debian's own.
status=0
unshare --mount --fork bash -euc '
  mount -t proc proc "$0/proc"
  mount --rbind /dev "$0/dev"
  mount --bind -o ro "$1" "$0/root/sources"
  exec chroot "$0" env -i HOME=/root TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
    bash -euc "$2" compilers "$3" "$4" "$5"
' "$debian" "$top" '
  pattern=$1 compilers=$2 jobs=$3 status=0
  packages="cmake ninja-build g++ clang libomp-dev liblammps-dev libopenmpi-dev libcli11-dev nlohmann-json3-dev libzstd-dev
    libxxhash-dev libgtest-dev python3"
  if ! dpkg-query -W $packages >/dev/null 2>&1; then
    { apt-get -q update && apt-get -q -y install --no-install-recommends $packages; } >/root/install.log 2>&1 || exit 77
  fi
  for compiler in $compilers; do
    $compiler --version | head -1
    cmake --preset cpu -S /root/sources -B /root/read-$compiler -G Ninja -D CMAKE_CXX_COMPILER=$compiler \
      -D LSDCD_TESTS=ON >/root/configure.log || { tail -20 /root/configure.log; exit 1; }
    cmake --build /root/read-$compiler --target lsdcd_grid_sources >/dev/null
    /root/sources/tests/tool/compiler_warnings.py /root/read-$compiler "$pattern" --jobs "$jobs" || status=1
  done
  exit $status
' "$pattern" "${LSDCD_COMPILERS:-g++ clang++}" "${LSDCD_HOST_JOBS:-$(nproc)}" </dev/null || status=$?
if [ "$status" -eq 77 ]; then skip "its packages cannot be installed ($debian/root/install.log)"; fi
exit "$status"
