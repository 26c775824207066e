#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Builds what build_host.sh has to test against, and prints options of CMake that name the folders.
#   build_all.sh [kinds] [mpi]   4Jul2026 with KOKKOS, whose own granular walls are the oracle of lammps.host.test_granular
#   kinds                        also with KOKKOS for threads and with atoms in float
#   mpi                          also 4Jul2026 with MPICH, without MPI, and without MPI and PLUGIN, LSDCD compiled in
# What it says goes to the standard error. What cannot be had is left out, and its tests say so; ends with 1 where a build fails.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
kokkos="" failed=0

# host OPTION [KIND]: builds it, and prints the option. KOKKOS_HOSTS takes all that may have Kokkos; one without gets no plugin for /kk.
host() {
  local text status=0
  echo "LAMMPS 4Jul2026 ${2:-}" >&2
  text=$("$here/build_host.sh" "${@:2}" </dev/null) || status=$?
  printf '%s\n' "$text" >&2
  case $status in 0) ;; 77) return ;; *) failed=1; return ;; esac
  if [ "$1" != KOKKOS_HOSTS ]; then echo "-DLSDCD_$1=${text##*$'\n'}"; fi
  case $1 in TEST_HOST | KOKKOS_HOSTS) kokkos+=";${text##*$'\n'}" ;; esac
}

host TEST_HOST
if [[ " $* " == *" kinds "* ]]; then
  for kind in openmp mixed single; do host KOKKOS_HOSTS $kind; done
fi
if [[ " $* " == *" mpi "* ]]; then
  host MPICH_HOST mpich
  host SERIAL_HOST serial
  host PACKAGE_HOST package
fi
echo "-DLSDCD_KOKKOS_HOSTS=${kokkos#;}"
exit $failed
