# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# The tests that are not of every day: `./run test all|sanitized|arm64` and `./run release-check`, which read this file.

test_all_packages=(
  "${doc_packages[@]}"                 # that the HTML has no broken link
  libcgal-dev libcgal-demo             # an independent distance oracle, and real meshes to try
  libsimbody-dev                       # a multibody code, whose wheel an example drives over grains
  libbullet-dev                        # a physics engine, whose crates an example drops on grains
  mmdebstrap                           # newer Debians, to install packages on
  valgrind                             # counts instructions of a step
  lintian                              # Debian's rules for packages
  clang-tidy                           # the checks of .clang-tidy
  reuse                                # that each file has its licence
  libmpich-dev mpich                   # another MPI library, for a LAMMPS and its plugin
)
arm64_packages=(
  g++-aarch64-linux-gnu                # compiles for 64-bit Arm
  qemu-user                            # runs what was compiled
)

# Of what takes turns, tests by LSDCD_DAY and groups of CUDA laws, each day has a third and a release all: 0, 1 or 2.
day() { echo $(($(date +%s) / 86400 % 3)); }

# Those groups compile the same sub-models, the first ones of each line the same law in another frame.
laws_of_other_days() {
  local groups=("energy granular plastic" "energy_records granular_added reaching" "impacts added on_wall")
  unset "groups[$(day)]"
  echo "^cuda_($(tr ' ' '|' <<<"${groups[*]}"))\$"
}

# Prints the option by which nvcc compiles fast what nothing runs, or what comes near to it before CUDA 13.
quick_ptx() { if PATH=$PATH:/usr/local/cuda/bin nvcc --help 2>/dev/null | grep -e --Ofast-compile >/dev/null; then echo --Ofast-compile=max; else echo -Xcicc=-O1; fi; }

# test_all [OPTION...]: options of ctest choose tests. Without a GPU CUDA code is for the one that
# bench.test_kernel_sizes has sizes for, and kernels of moving walls are for a release. Nothing runs other laws there: with little
# optimisation they compile in a third of the time, and the host's half of them, which starts kernels, in half.
test_all() {
  local folder=build/all kinds=() text hosts=() options=(-D LSDCD_TESTS=ON -D LSDCD_RELEASE="$whole") laws='on_wall|plain' left_out= today=
  # LAMMPS needs none of the packages that are installed meanwhile. build_all.sh below waits for it, and says what went wrong.
  if [ $whole = OFF ]; then tests/lammps/hosts/build_host.sh >/dev/null 2>&1 </dev/null & fi
  need_each "${test_all_packages[@]}"
  if [ $whole = OFF ]; then laws='^plain$' left_out=$(laws_of_other_days) today=$(day); fi
  options+=(-D LSDCD_DAY="$today")
  have_gpu || options+=(-D CMAKE_CUDA_ARCHITECTURES=90 -D LSDCD_MACHINE_LAWS="$laws" -D LSDCD_LEAVE_OUT="$left_out"
    -D LSDCD_PTX_OPTIONS="$(quick_ptx);-Xcompiler=-O1")
  say "configure"
  configure cuda $folder "${options[@]}" || { fail "configure"; return; }
  if wanted $folder -L host "$@"; then
    if [[ "$*" != *release* ]]; then kinds=(kinds); fi
    if wanted $folder -L mpi "$@"; then kinds+=(mpi); fi
    say "LAMMPS from source, kept in $LSDCD_HOSTS"
    text=$(tests/lammps/hosts/build_all.sh "${kinds[@]}") || fail "LAMMPS from source"
    if [ -n "$text" ]; then mapfile -t hosts <<<"$text"; fi
  fi
  say "build"
  configure cuda $folder "${options[@]}" "${hosts[@]}" && compile $folder || { fail "build"; return; }
  say "tests"
  run_ctest $folder "$@"
}

# Under sanitizers, each of which makes the compiler take twice as long and a test several times, other modules than these are for a
# release.
sanitized_modules=(base shape rigid contact engine wall input)

# The tests of every day under sanitizers: random meshes stand for real ones, tests of the tool's commands one by one for
# its examples in a row. Sampling tests take a tenth of their samples: the same code runs, and a sanitizer makes each
# several times as slow.
test_sanitized() {
  local targets=(quick) chosen=(-LE full -E '^tool[.](test_(tradeoff|commands)|format)$')
  if [ $whole = OFF ]; then
    targets=("${sanitized_modules[@]/%/_tests}")
    chosen=(-LE full -L "^($(IFS='|'; echo "${sanitized_modules[*]}"))\$")
  fi
  say "sanitizers: configure and build"
  configure sanitize build/sanitize -D LSDCD_RELEASE="$whole" || { fail "configure with sanitizers"; return; }
  wanted build/sanitize "${chosen[@]}" || return 0
  compile build/sanitize "${targets[@]}" || { fail "build with sanitizers"; return; }
  say "sanitizers: tests"
  LSDCD_QUICK=1 LSDCD_PAIRS=2e5 run_ctest build/sanitize "${chosen[@]}"
}

# The library, the tool and the unit tests for 64-bit Arm, compiled by Debian's cross compiler and run in qemu, which takes each
# test about twenty times as long as a processor would: tests of random pairs take a tenth of the pairs of ./run test. Debian's
# arm64 libraries come through lists of their own, so that this machine's packages stay as they are.
test_arm64() {
  local root=$LSDCD_HOSTS/arm64 package
  local apt=(apt-get -q -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::Lists="$root/lists"
             -o Dir::Cache="$root/cache" -o Debug::NoLocking=1 -o APT::Sandbox::User=root)
  need_to "the build for Arm needs" "${arm64_packages[@]}"
  if [ ! -f "$root/complete" ]; then
    mkdir -p "$root/lists/partial" "$root/cache/archives/partial" "$root/packages"
    "${apt[@]}" update </dev/null || die "no lists of Debian's arm64 packages"
    (cd "$root/packages" && "${apt[@]}" download libgtest-dev libzstd-dev libzstd1 libxxhash-dev libxxhash0 \
      libcli11-dev nlohmann-json3-dev </dev/null) || die "Debian's arm64 libraries do not come from the mirror"
    for package in "$root"/packages/*.deb; do dpkg -x "$package" "$root/root"; done
    touch "$root/complete"
  fi
  say "build for 64-bit Arm; Debian's libraries for it are kept in $root"
  # Little optimisation, as with sanitizers: it does not change an answer, and most tests run for less time than it would take.
  configure cpu build/arm64 --toolchain cmake/arm64.cmake -D LSDCD_ARM64_ROOT="$root/root" -D LSDCD_LAMMPS=OFF \
    -D LSDCD_TESTS=ON -D CMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" && compile build/arm64 quick || { fail "build for Arm"; return; }
  say "tests in qemu"
  LSDCD_QUICK=1 LSDCD_PAIRS=1e5 run_ctest build/arm64 -LE full --timeout 3600 -E '^(bits|library|tool)[.]'
}

# test_full all|sanitized|arm64 [PATTERN]: what only a release asks for is left out of `all` unless a pattern names it.
test_full() {
  local chosen=()
  whole=ON
  [ $# -le 2 ] || die "test $1 takes one pattern: ${*:2}"
  pattern=${2:-.}
  need_to "the build needs" "${build_packages[@]}"
  need_each "${test_packages[@]}"
  if [ "$*" = all ] && [ -z "${release:-}" ]; then
    chosen=(-LE release)
    whole=OFF
  fi
  "test_$1" "${chosen[@]}"
  if [ "$1" = all ]; then test_sanitized; fi
  report
}

# What RELEASING.md lists; what fails early first.
release_check() {
  need_to "the build needs" "${build_packages[@]}"
  say "versions, formats, commits"
  "$python" tests/tool/check_release.py --release || die "not ready for a release: see the lines with FAIL"
  release=1 test_full all
  package
  say "programs and packages"
  "$python" tests/tool/check_release.py --build build --packages build/packages
  say "ready for a release; what was skipped is above"
}
