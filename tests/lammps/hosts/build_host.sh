#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Builds a LAMMPS to test against, from Debian's parts and outside the tree.
#   build_host.sh [KIND]     builds it unless it is there; the last line is its folder. Without a KIND it is 4Jul2026 of Debian's sid,
#                            whose granular walls ours are checked against, with a Kokkos of its own
#   build_host.sh pack FILE  writes the sources into an archive of 7 MB, for a machine that reaches no mirror
#   KIND mpich               with MPICH instead of the machine's own MPI
#   KIND serial              without MPI
#   KIND package             without MPI and PLUGIN, with the styles of this tree compiled in (cmake/packaging/lammps)
#   KIND mixed, single       with a Kokkos that has atoms in float, and adds forces in double or in float
#   KIND openmp              with a Kokkos for threads (-k on t N)
#   KIND cuda                with a Kokkos for the GPU of this machine (-k on g 1), which nvcc compiles
#   LSDCD_HOST_SOURCES       an archive that `pack` has written, which is read in place of the mirror's
#   LSDCD_HOSTS              where (default ${XDG_CACHE_HOME:-~/.cache}/lsdcd/hosts)
#   LSDCD_HOST_JOBS          compilers at once (default: one per core)
# All have the packages GRANULAR and, but for KIND package, PLUGIN; those whose KIND is not one of MPI also KOKKOS (Serial and double where
# KIND does not say otherwise), GRAPHICS, fix rigid/small and what superellipsoids need of ASPHERE, these three not in float. The
# folder, 20260704 or 20260704-KIND, then holds
#   lmp, liblammps.so.0      the program; both resolve their libraries from the folder itself
#   src/                     headers of LAMMPS, those of its package KOKKOS in src/KOKKOS
#   kokkos/                  include/ and lib/ of Kokkos
#   unittest/granular/tests  without a KIND: LAMMPS's own tests of granular styles, which tests/validation/lammps_yaml.py reads
#   host.cmake               what a plugin for it is compiled with, as CMake variables: its KIND, its
#                            Kokkos ("" without), includes, definitions, least C++ standard; with another MPI
#                            the folders of mpi.h
# 80 to 215 MB come from the mirror that this machine's apt uses; the build takes some minutes.
# Exits 77 with a line "skipped: ..." where source or tools cannot be had. Without the source
# of Kokkos 4Jul2026 is built without it, which a line says: host.cmake then names none.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/debian_mirror.sh"

skip() { echo "skipped: $*"; exit 77; }
die() { echo "build_host.sh: $*" >&2; exit 1; }

# 4Jul2026. Pool paths and checksums are those of Debian's source packages.
version=20260704
source=lammps/lammps_20260704+dfsg.orig.tar.gz
sha256=cddbc45a047416bd48a4a0b87f24a5b61b3446982b74d18cafe619c22b17eb62
# LAMMPS asks for 5.1, but needs nothing that 5.0 lacks, and 5.0.2 is what the pool has.
kokkos=5.0.2
kokkos_source=kokkos/kokkos_5.0.2.orig.tar.gz
kokkos_sha256=188817bb452ca805ee8701f1c5adbbb4fb83dc8d1c50624566a18a719ba0fa5e
standard=20
defines="LMP_KOKKOS LMP_KOKKOS_LAYOUT_LEGACY"
their_tests=unittest/granular/tests
kind=${1:-} packed="" mpi="" backend=SERIAL precision=double build_mpi=on mpicxx=mpicxx mpi_options=()
case $kind in
  "") ;;
  pack) packed=$(realpath "${2:?pack takes the name of the archive}") ;;
  mpich) mpi=mpich mpicxx=mpicxx.mpich mpi_options=(-D MPI_C_COMPILER=mpicc.mpich -D MPI_CXX_COMPILER=mpicxx.mpich) ;;
  serial | package) mpi=serial build_mpi=off mpicxx=c++ ;;
  mixed | single) precision=$kind ;;
  openmp) backend=OPENMP ;;
  cuda)
    backend=CUDA
    export PATH=$PATH:/usr/local/cuda/bin
    command -v nvcc >/dev/null || skip "no nvcc on this machine" ;;
  *) die "no such kind: $kind (mpich, serial, package, mixed, single, openmp or cuda)" ;;
esac

# -O1 compiles in two thirds of the time of -O2, and the scripts are small. No contraction:
# our own build has none, and the two are compared to the last bits.
flags="-O1 -ffp-contract=off"
options=(-D BUILD_SHARED_LIBS=on -D BUILD_MPI=$build_mpi -D BUILD_OMP=off
         -D PKG_GRANULAR=on -D PKG_PLUGIN=on -D PKG_GRAPHICS=on -D PKG_RIGID=on
         -D WITH_JPEG=off -D WITH_PNG=off -D WITH_FFMPEG=off -D WITH_GZIP=off -D WITH_CURL=off
         -D CMAKE_BUILD_TYPE=None)
small=
if [ -n "$mpi" ] || [ $precision != double ]; then    # what a plugin is tried with, and no more
  small=yes flags="-O0 -ffp-contract=off"
  options=("${options[@]/PKG_GRAPHICS=on/PKG_GRAPHICS=off}")
  options=("${options[@]/PKG_RIGID=on/PKG_RIGID=off}")
fi
if [ -z "$small" ]; then options+=(-D PKG_ASPHERE=on); fi
if [ -n "$mpi" ]; then kokkos=; fi
ours=    # the sources that are compiled in
if [ "$kind" = package ]; then
  tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../.." && pwd)
  options=("${options[@]/PKG_PLUGIN=on/PKG_PLUGIN=off}" -D LSDCD_CUDA=OFF
           -D CMAKE_PROJECT_lammps_INCLUDE="$tree/cmake/packaging/lammps/LSDCD.cmake")
  ours=$(cd "$tree" && find CMakeLists.txt cmake src -type f -print0 | LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -c1-16)
fi
atomics_bypass=on    # with one thread only
if [ $backend = OPENMP ]; then options=("${options[@]/BUILD_OMP=off/BUILD_OMP=on}") atomics_bypass=off; fi
if [ $backend = CUDA ]; then atomics_bypass=off; fi
# LAMMPS's name for the precision of atoms, and of sums.
case $precision in
  double) defines+=" LMP_KOKKOS_DOUBLE_DOUBLE" ;;
  mixed) defines+=" LMP_KOKKOS_SINGLE_DOUBLE" options+=(-D KOKKOS_PREC=mixed) ;;
  single) defines+=" LMP_KOKKOS_SINGLE_SINGLE" options+=(-D KOKKOS_PREC=single) ;;
esac
# As LAMMPS asks of the Kokkos that it builds itself.
kokkos_options=(-D BUILD_SHARED_LIBS=on -D Kokkos_ENABLE_SERIAL=on -D Kokkos_ENABLE_IMPL_VIEW_LEGACY=on
                -D Kokkos_ENABLE_ATOMICS_BYPASS=$atomics_bypass -D CMAKE_CXX_STANDARD="$standard"
                -D CMAKE_CXX_EXTENSIONS=off -D CMAKE_INSTALL_LIBDIR=lib -D CMAKE_BUILD_TYPE=None)
if [ $backend != SERIAL ]; then kokkos_options+=(-D Kokkos_ENABLE_$backend=on); fi
if [ $backend = CUDA ]; then    # for this machine's GPU, or for an H100 or H200 where there is none
  capability=$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -1 | tr -d . || true)
  if [ -z "$capability" ]; then kokkos_options+=(-D Kokkos_ARCH_HOPPER90=on); fi
  capability=${capability:-90}
  kokkos_options+=(-D Kokkos_ENABLE_IMPL_CUDA_MALLOC_ASYNC=off)
fi

hosts=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}
folder=$hosts/$version${kind:+-$kind}
work=$folder/work
jobs=${LSDCD_HOST_JOBS:-$(env -u OMP_NUM_THREADS nproc)}    # which else says how many threads a program may have

for tool in cmake c++ $mpicxx flock sha256sum tar; do
  command -v $tool >/dev/null || skip "no $tool on this machine"
done
mkdir -p "$folder"

# Two runs at once: the second waits, and then finds everything there.
exec 9>"$folder/lock"
flock 9

# fetch POOL_PATH SHA256: into $work. apt-helper goes through apt's own proxies and refuses
# a file with another checksum.
fetch() {
  local helper=/usr/lib/apt/apt-helper mirror file=${1##*/} path=$1
  mirror=$(debian_mirror)
  why=
  if [ ! -x $helper ]; then why="no apt here to fetch $file with"; return 1; fi
  if [ -z "$mirror" ]; then why="apt has no Debian mirror configured"; return 1; fi
  echo "fetching $file"
  $helper -o APT::Sandbox::User=root download-file "$mirror/pool/main/${path:0:1}/$path" "$work/$file" \
    "SHA256:$2" >"$work/log" 2>&1 && return 0
  tail -3 "$work/log"
  why="$file does not come from the mirror"
  return 1
}

# Both put sources into $work: the archive of `pack`, or what the mirror has.
kokkos_sources() {
  if [ -n "${LSDCD_HOST_SOURCES:-}" ]; then
    tar -xf "$LSDCD_HOST_SOURCES" -C "$work" kokkos || die "cannot unpack $LSDCD_HOST_SOURCES"
    return 0
  fi
  fetch "$kokkos_source" "$kokkos_sha256" || return 1
  mkdir "$work/kokkos"
  tar -xf "$work/${kokkos_source##*/}" -C "$work/kokkos" --strip-components=1 || die "cannot unpack $kokkos_source"
}

lammps_sources() {
  if [ -n "${LSDCD_HOST_SOURCES:-}" ]; then
    tar -xf "$LSDCD_HOST_SOURCES" -C "$work" cmake src lib LICENSE || die "cannot unpack $LSDCD_HOST_SOURCES"
    tar -xf "$LSDCD_HOST_SOURCES" -C "$work" $their_tests 2>/dev/null || true    # an older archive has none
    return 0
  fi
  fetch "$source" "$sha256" || skip "$why"
  tar -xf "$work/${source##*/}" -C "$work" cmake src lib LICENSE $their_tests || die "cannot unpack $source"
  rm "$work/${source##*/}"
}

# Keeps LAMMPS's own tests of granular styles beside the host, where the sources have them.
keep_their_tests() {
  if [ -n "$kind" ] || [ ! -d "$work/$their_tests" ]; then return; fi
  rm -rf "${folder:?}/$their_tests"
  mkdir -p "$folder/${their_tests%/*}"
  cp -r "$work/$their_tests" "$folder/$their_tests"
}

# pack FILE: for LSDCD_HOST_SOURCES, without those folders of sources that take most room and that no kind of build reads.
pack() {
  local folder
  kokkos_sources || skip "$why"
  lammps_sources
  for folder in benchmarks example; do    # Kokkos asks that they are there
    rm -rf "$work/kokkos/$folder"
    mkdir "$work/kokkos/$folder"
    touch "$work/kokkos/$folder/CMakeLists.txt"
  done
  tar -cJf "$1" -C "$work" --exclude=lib/{gpu,colvars,lepton} --exclude=src/{OPENMP,INTEL,GPU} --exclude=kokkos/containers/unit_tests \
    --exclude=kokkos/core/{unit_test,perf_test} kokkos cmake src lib LICENSE $their_tests
  echo "$1"
}

# For a GPU files that see Kokkos are compiled by nvcc, and all others, nine of ten, by g++ in a tenth of the time. Kokkos's own
# script nvcc_wrapper makes g++'s words those of nvcc.
choose_compilers() {
  if [ $backend != CUDA ]; then return; fi
  [ -d "$work/kokkos" ] || kokkos_sources || die "no sources of Kokkos: $why"
  cat >"$work/compiler" <<TEXT
#!/usr/bin/env bash
# The file that is compiled is the word behind -c.
for word in "\$@"; do
  if [ "\${before:-}" = -c ] && [[ \$word != */KOKKOS/* && \$word != */kokkos/* ]] &&
    ! grep -qE 'accelerator_kokkos.h|"style_' "\$word"; then
    words=()
    for word in "\$@"; do case \$word in -arch=* | *extended-lambda | -Wext-lambda* | *diag_suppress*) ;; *) words+=("\$word") ;; esac; done
    exec g++ "\${words[@]}"
  fi
  before=\$word
done
[[ "\$*" == *-arch=* ]] || set -- -arch=sm_$capability "\$@"
exec "$work/kokkos/bin/nvcc_wrapper" "\$@"
TEXT
  chmod +x "$work/compiler"
  options+=(-D CMAKE_CXX_COMPILER="$work/compiler")
  kokkos_options+=(-D CMAKE_CXX_COMPILER="$work/compiler")
}

generator=() launcher=()
if command -v ninja >/dev/null; then generator=(-G Ninja); fi
if command -v ccache >/dev/null && [ $backend != CUDA ]; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
export CCACHE_BASEDIR=$folder CCACHE_NOHASHDIR=1

# compile WHAT TARGET SOURCE BUILD [option...]: libraries are found beside the program.
compile() {
  local what=$1 target=$2 from=$3 to=$4
  shift 4
  echo "building $what with $jobs compilers"
  {
    cmake -S "$from" -B "$to" "${generator[@]}" "${launcher[@]}" -D CMAKE_CXX_FLAGS="$flags" \
      -D CMAKE_BUILD_WITH_INSTALL_RPATH=on -D CMAKE_INSTALL_RPATH='$ORIGIN;$ORIGIN/kokkos/lib' \
      "$@" </dev/null &&
      cmake --build "$to" -j "$jobs" --target "$target" </dev/null
  } >"$work/log" 2>&1 || { tail -40 "$work/log" >&2; die "$what does not build"; }
}

tools="$(c++ -dumpfullversion) $(mpicxx --showme:link 2>/dev/null || true)"
if [ -n "$mpi" ]; then tools="$(c++ -dumpfullversion) $mpi"; fi
rm -rf "$work"
mkdir "$work"
trap 'rm -rf "$work"' EXIT
if [ -n "$packed" ]; then pack "$packed"; exit; fi

# ---- Kokkos ------------------------------------------------------------------------------

stamp="1 $kokkos $flags ${kokkos_options[*]} $tools"
if [ -n "$kokkos" ] && [ "$(cat "$folder/kokkos/stamp" 2>/dev/null)" != "$stamp" ]; then
  rm -rf "$folder/kokkos"
  if kokkos_sources; then
    choose_compilers
    compile "Kokkos $kokkos" install "$work/kokkos" "$work/kokkos-build" \
      -D CMAKE_INSTALL_PREFIX="$folder/kokkos" "${kokkos_options[@]}"
    echo "$stamp" >"$folder/kokkos/stamp"
  else
    echo "without KOKKOS: $why"
    kokkos=
  fi
fi

# ---- LAMMPS ------------------------------------------------------------------------------

if [ -n "$kokkos" ]; then
  options+=(-D PKG_KOKKOS=on -D EXTERNAL_KOKKOS=on -D CMAKE_CXX_STANDARD="$standard")
fi
stamp="3 $version $sha256 kokkos=$kokkos $flags ${options[*]} $tools$ours"
if [ -x "$folder/lmp" ] && [ "$(cat "$folder/stamp" 2>/dev/null)" = "$stamp" ]; then
  if [ -z "$kind" ] && [ ! -d "$folder/$their_tests" ]; then    # it was built before these were kept
    (lammps_sources) || echo "without LAMMPS's own tests"
    keep_their_tests
  fi
  echo "$folder"
  exit 0
fi
rm -rf "$folder"/{stamp,host.cmake,src,lmp} "$folder"/liblammps.so*
lammps_sources
keep_their_tests
choose_compilers
# Styles of molecules, thermostats and the like take half of the time, and no script needs them.
find "$work/src/KOKKOS" -name 'pair_*_kokkos.*' ! -name 'pair_gran_*' ! -name 'pair_hybrid*' -delete
rm -f "$work"/src/KOKKOS/{angle,bond,dihedral,improper}_* \
  "$work"/src/{.,KOKKOS}/fix_{langevin,nph,npt,nvt,press,temp,spring,restrain,indent,recenter}[._]* \
  "$work"/src/{.,KOKKOS}/fix_{lineforce,planeforce,drag,momentum,wall_lj*,wall_harmonic,wall_morse,box_relax}[._]* \
  "$work"/src/fix_{ave_correlate,ave_chunk,heat,tmd,thermal_conductivity,viscosity}[._]* \
  "$work"/src/{.,KOKKOS}/compute_{orientorder,hexorder,coord,centro,cna,rdf,adf,msd,vacf,gyration}[._]* \
  "$work"/src/{.,KOKKOS}/compute_temp_{com,deform,partial,profile,ramp}[._]* \
  "$work"/src/compute_{angle,bond,dihedral,improper,inertia,dipole,torque,omega,angmom,vcm,displace}[._]* \
  "$work"/src/compute_{cluster,aggregate,heat_flux}[._]* "$work"/src/KOKKOS/atom_vec_charge_*
if [ $precision$backend != doubleSERIAL ]; then
  # Of its package KOKKOS the styles that the scripts use, and what LAMMPS names in its list of sources.
  find "$work/src/KOKKOS" -regextype egrep -regex '.*/(atom_vec|compute|dynamical|fix|min|pair|third)_.*' ! -regex \
    ".*/(atom_vec(_sphere|_atomic)?|compute_(temp|erotate_sphere)|min(_cg|_linesearch)?|pair(_gran_hooke_history|_hybrid|_hybrid_overlay)?)_kokkos[.].*" ! -regex \
    ".*/fix_(enforce2d|freeze|gravity|minimize|neigh_history|nh|nh_sphere|nve|nve_sphere|property_atom|setforce|wall_gran)_(kokkos|old)[.].*" -delete
fi
if [ -n "$small" ] || [ $backend != SERIAL ]; then
  rm -f "$work"/src/pair_{born,buck,coul,lj,morse,table,yukawa,zbl,write}[._]* "$work"/src/min_{fire,hftn,quickmin,sd}.* \
    "$work"/src/compute_{centroid,com,count,fragment,global,group,property_chunk,property_grid,property_local}[._]* \
    "$work"/src/compute_{reduce_chunk,temp_chunk,temp_region,chunk_spread_atom}[._]* \
    "$work"/src/{angle,bond,dihedral,improper}_{zero,write}.* "$work"/src/dump_{cfg,grid,xyz}[._]* \
    "$work"/src/fix_{ave_grid,aveforce,efield,evaporate,nve_limit,wall_region,wall_table}[._]* \
    "$work"/src/GRANULAR/{compute_fabric,fix_add_heat,fix_addtorque_atom,fix_damping_cundall,fix_settorque_atom}.* \
    "$work"/src/GRANULAR/fix_viscous_nonlinear.* "$work"/src/reset_atoms_*
fi
if [ -n "$small" ]; then
  rm -f "$work"/src/{pair_soft,compute_reduce_region,compute_slice,compute_pair_local,fix_ave_histo,dump_local,fix_nve_noforce}[._]*
fi
find "$work/src/RIGID" -type f ! -name 'fix_rigid_small.*' ! -name rigid_const.h -delete
find "$work/src/ASPHERE" -type f ! -name 'fix_nve_asphere.*' ! -name '*superellipsoid*' ! -name 'compute_erotate_*' -delete

# LAMMPS asks for a later version than the pool has. What is compiled against it decides.
if [ -n "$kokkos" ]; then
  cat >"$work/KokkosConfigVersion.cmake" <<TEXT
set(PACKAGE_VERSION $kokkos)
set(PACKAGE_VERSION_COMPATIBLE TRUE)
TEXT
  echo "include($folder/kokkos/lib/cmake/Kokkos/KokkosConfig.cmake)" >"$work/KokkosConfig.cmake"
  # Kokkos's library needs the driver's, which a machine without a GPU lacks.
  options+=(-D CMAKE_EXE_LINKER_FLAGS="-Wl,-rpath-link,$folder/kokkos/lib,--allow-shlib-undefined" -D Kokkos_DIR="$work")
fi
# To parse the same headers takes most of the time that a file is compiled: that is done once, where one compiler has all files.
[ $backend = CUDA ] || {
  echo "#ifdef __cplusplus"
  printf '#include <%s>\n' mpi.h algorithm cmath map string vector \
    ${kokkos:+Kokkos_Core.hpp Kokkos_DualView.hpp Kokkos_ScatterView.hpp Kokkos_UnorderedMap.hpp}
  echo "#endif"
} >"$work/parsed_once.h"
[ $backend = CUDA ] || echo "target_precompile_headers(lammps PRIVATE $work/parsed_once.h)" >>"$work/cmake/CMakeLists.txt"
export CCACHE_SLOPPINESS=pch_defines,time_macros
compile "LAMMPS $version" lmp "$work/cmake" "$work/build" "${options[@]}" "${mpi_options[@]}"

# What is kept: the program, its library beside it, the headers, and how they were compiled.
cp -P "$work"/build/liblammps.so* "$work/build/lmp" "$folder"
mkdir "$folder/src"
(cd "$work/src" && find . -name '*.h' -exec cp --parents -t "$folder/src" {} + &&
  { [ ! -d nlohmann ] || cp -r nlohmann "$folder/src"; })
{
  echo "set(LSDCD_HOST_VERSION $version)"
  echo "set(LSDCD_HOST_KIND \"$kind\")"
  case $mpi in
    mpich) echo "set(LSDCD_HOST_MPI_INCLUDES $($mpicxx -show | grep -o -- '-I[^ ]*' | sed 's/^-I//' | paste -s -d' '))" ;;
    serial) echo 'set(LSDCD_HOST_MPI_INCLUDES "${CMAKE_CURRENT_LIST_DIR}/src/STUBS")' ;;
  esac
  echo "set(LSDCD_HOST_KOKKOS \"$kokkos\")"
  if [ -n "$kokkos" ]; then
    echo "set(LSDCD_HOST_KOKKOS_INCLUDES \"\${CMAKE_CURRENT_LIST_DIR}/src/KOKKOS\" \"\${CMAKE_CURRENT_LIST_DIR}/kokkos/include\")"
    echo "set(LSDCD_HOST_KOKKOS_DEFINITIONS $defines)"
    echo "set(LSDCD_HOST_KOKKOS_STANDARD $standard)"
  fi
} >"$folder/host.cmake"
echo "$stamp" >"$folder/stamp"
echo "$folder"
