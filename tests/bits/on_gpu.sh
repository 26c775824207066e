#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# What only a machine with a GPU can show, in one command that ends within ten minutes and fetches nothing.
#
#   tests/bits/on_gpu.sh [REFERENCE] [--host FOLDER] [--out FOLDER] [--cmake WORDS] [--seconds 570]
#
#   REFERENCE    the program to compare with: a commit, an archive of its sources where there is no git (git
#                archive -o reference.tar COMMIT), or a folder in which it was built with CUDA
#   --host       a LAMMPS 4Jul2026 with KOKKOS for CUDA, GRANULAR and PLUGIN, built before: its build folder, or one
#                with lmp, src/ and host.cmake
#   --out        where builds, logs and rows go (build-gpu)
#   --cmake      further words for cmake, as "-D GTest_DIR=..."
#   --seconds    after which no part goes on
#
# Parts: build; CUDA tests, whose results go into doc/data/gpu_tests.csv (tests/tool/gpu_record.py); the harness (compare.py) with
# CUDA, on lmp-lsdcd and on /kk; bench step; the closed box with /kk. Each has one line with its seconds; what cannot be run is skipped by name. The exit status is 1 where a
# part failed.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit 2

die() { echo "on_gpu.sh: $*" >&2; exit 2; }
reference="" host="" out=build-gpu more=() limit=570
while [ $# -gt 0 ]; do
  case $1 in
    --host) host=$(realpath "${2:?}") || die "no folder $2"; shift ;;
    --out) out=${2:?}; shift ;;
    --cmake) read -ra more <<<"${2:?}"; shift ;;
    --seconds) limit=${2:?}; shift ;;
    -h | --help) sed -n '2,/^set/p' "${BASH_SOURCE[0]}" | sed '/^set/d; s/^# \{0,1\}//'; exit 0 ;;
    -*) die "no such word: $1 (--help)" ;;
    *) reference=$1 ;;
  esac
  shift
done
command -v nvcc >/dev/null || [ -x /usr/local/cuda/bin/nvcc ] || die "no nvcc in PATH or in /usr/local/cuda"
compgen -G '/dev/nvidia[0-9]*' >/dev/null || die "no GPU here"
mkdir -p "$out" || die "cannot make $out"
out=$(realpath "$out")
python=/usr/bin/python3
[ -x $python ] || python=$(command -v python3) || die "no python3"
jobs=$(nproc)
kokkos_flags="-k on g 1 -sf kk -pk kokkos newton off neigh half"
# Other folders than the user's, so that a machine that is given back loses nothing of theirs.
export XDG_CACHE_HOME=${XDG_CACHE_HOME:-$out/cache} OMP_NUM_THREADS=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_pml=ob1 OMPI_MCA_ess_singleton_isolated=1

failed=0
line() { printf '%-10s%6d s  %-34s%s\n' "$1" "$2" "$3" "${4:-}"; }
skip() { line skipped 0 "$1" "$2"; }

# part NAME LOG COMMAND...: one line, and what its log ends with where it fails.
part() {
  local name=$1 log=$out/$2 began=$SECONDS status=0 left=$((limit - SECONDS))
  shift 2
  if [ $left -lt 5 ]; then skip "$name" "no time left of $limit s"; failed=1; return 1; fi
  timeout "$left" "$@" >"$log" 2>&1 </dev/null || status=$?
  if [ $status -eq 0 ]; then
    line ok $((SECONDS - began)) "$name" "$(tail -n 1 "$log" | cut -c1-90)"
    return 0
  fi
  failed=1
  line FAILED $((SECONDS - began)) "$name" "$([ $status -eq 124 ] && echo "no time left of $limit s; ")status $status, $log"
  tail -n 15 "$log" | sed 's/^/    /'
  return 1
}

# ---- build -------------------------------------------------------------------------------

build=$out/build
words=(-D LSDCD_TESTS=ON -D LSDCD_CUDA=ON "${more[@]}")
if [ -n "$host" ]; then
  # LAMMPS's headers, where Debian's are not there.
  include=$host/src
  if [ ! -f "$include/lammps.h" ] && [ -f "$host/CMakeCache.txt" ]; then
    include=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$host/CMakeCache.txt")/../src
  fi
  [ -f "$include/lammps.h" ] || die "no headers of LAMMPS for $host: neither src/lammps.h nor a CMakeCache.txt"
  words+=(-D LSDCD_KOKKOS_HOST="$host")
  compgen -G '/usr/include/lammps/lammps.h' >/dev/null || words+=(-D LSDCD_HOST_INCLUDE="$(realpath "$include")")
fi
generator=()
if command -v ninja >/dev/null; then generator=(-G Ninja); fi
part "configure" configure.log cmake -S . -B "$build" "${generator[@]}" -D CMAKE_BUILD_TYPE=Release "${words[@]}" || exit 1

# CUDA tests by their names in CTest; a target of the same name builds the program.
mapfile -t tests < <(ctest --test-dir "$build" -N -L cuda 2>/dev/null |
  sed -n 's/^ *Test *#[0-9]*: \(test_[a-z0-9_]*\)\..*/\1/p' | sort -u)
targets=("${tests[@]}" bench_step)
known=$(cmake --build "$build" --target help 2>/dev/null)
[[ $known == *lmp-lsdcd* ]] && targets+=(lmp-lsdcd)
[ -n "$host" ] && targets+=(lsdcdkkplugin)
part "build" build.log cmake --build "$build" -j "$jobs" --target "${targets[@]}" || exit 1

# ---- tests -------------------------------------------------------------------------------

named=$(git rev-parse --short=8 HEAD 2>/dev/null || echo "on a GPU")
# Small samples; LSDCD_PAIRS asks for more.
[ ${#tests[@]} -gt 0 ] || { line FAILED 0 "CUDA tests" "none in this build: was CUDA left out? $out/configure.log"; failed=1; }
[ ${#tests[@]} -eq 0 ] || part "CUDA tests, ${#tests[@]} files" tests.log env LSDCD_QUICK=1 LSDCD_PAIRS="${LSDCD_PAIRS:-1e6}" \
  "$python" tests/tool/gpu_record.py --build "$build" --commit "$named" -R '^test_' -j 4 --timeout 200 --output-on-failure

# ---- the harness -------------------------------------------------------------------------

forms=()
if [ -x "$build/bin/lmp-lsdcd" ]; then forms+=(plain); else skip "harness, lmp-lsdcd" "no LAMMPS here to build it with"; fi
if [ -n "$host" ]; then forms+=(host kk); else skip "harness, /kk" "no --host"; fi
if [ -z "$reference" ]; then
  skip "harness" "no REFERENCE"
elif [ ${#forms[@]} -gt 0 ]; then
  part "harness: ${forms[*]}" harness.log "$python" tests/bits/compare.py "$reference" --build "$build" --as-built --cuda \
    --quick --ranks 1 --jobs 4 --forms "$(IFS=,; echo "${forms[*]}")" ${host:+--host "$host"} \
    --kokkos-flags "$kokkos_flags" --cmake "${words[*]:4}"
fi

# ---- speed -------------------------------------------------------------------------------

mkdir -p "$out/rows"
quick=()
if [ $((limit - SECONDS)) -lt 180 ]; then quick=(--quick); fi
part "bench step${quick:+, quick}" step.log "$python" bench/run.py --build "$build" --only cuda --rows-to "$out/rows" \
  --commit "$named" "${quick[@]}" step
if [ -n "$host" ]; then
  part "closed box, /kk" box.log "$python" bench/run.py --build "$build" --rows-to "$out/rows" --commit "$named" kokkos \
    --lmp "$host/lmp" --plugin "$build/lib/lsdcdkkplugin.so" --flags "$kokkos_flags" --cases box --atoms 1e6 \
    --orders sorted --rounds 1 --settle 1000
else
  skip "closed box, /kk" "no --host"
fi

line "$([ $failed -eq 0 ] && echo ok || echo FAILED)" "$SECONDS" "all" "logs and rows are in $out"
exit $failed
