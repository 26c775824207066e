#!/usr/bin/env bash
# Builds the LAMMPS that granular walls are checked against: 4Jul2026, from the source
# package of Debian's sid, with the packages GRANULAR and PLUGIN, outside the tree.
#   build_host.sh            builds it unless it is there; the last line is its folder
#   LSDCD_HOSTS              where (default ${XDG_CACHE_HOME:-~/.cache}/lsdcd/hosts)
#   LSDCD_HOST_JOBS          compilers at once (default: one per core)
# The folder then holds lmp, liblammps.so.0 and src/ with its headers. About 215 MB come
# from the mirror that this machine's apt uses; the build takes some minutes.
# Exits 77 with a line "skipped: ..." where source or tools cannot be had.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/debian_mirror.sh"

version=20260704
file=lammps_$version+dfsg.orig.tar.gz
sha256=cddbc45a047416bd48a4a0b87f24a5b61b3446982b74d18cafe619c22b17eb62
# -O1 compiles in two thirds of the time of -O2, and the decks are small. No contraction:
# our own build has none, and the two are compared to the last bits.
flags="-O1 -ffp-contract=off"
options=(-D BUILD_SHARED_LIBS=on -D BUILD_MPI=on -D BUILD_OMP=off
         -D PKG_GRANULAR=on -D PKG_PLUGIN=on
         -D WITH_JPEG=off -D WITH_PNG=off -D WITH_FFMPEG=off -D WITH_GZIP=off -D WITH_CURL=off
         -D CMAKE_BUILD_TYPE=None)

hosts=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}
folder=$hosts/$version
jobs=${LSDCD_HOST_JOBS:-$(nproc)}

skip() { echo "skipped: $*"; exit 77; }
die() { echo "build_host.sh: $*" >&2; exit 1; }

for tool in cmake c++ mpicxx flock sha256sum tar; do
  command -v $tool >/dev/null || skip "no $tool on this machine"
done
mkdir -p "$folder"

# Two runs at once: the second waits, and then finds everything there.
exec 9>"$folder/lock"
flock 9

stamp="2 $version $sha256 $flags ${options[*]} $(c++ -dumpfullversion) $(mpicxx --showme:link 2>/dev/null || true)"
if [ -x "$folder/lmp" ] && [ "$(cat "$folder/stamp" 2>/dev/null)" = "$stamp" ]; then
  echo "$folder"
  exit 0
fi

helper=/usr/lib/apt/apt-helper
[ -x $helper ] || skip "no apt here to fetch the source of LAMMPS with"
mirror=$(debian_mirror)
[ -n "$mirror" ] || skip "apt has no Debian mirror configured"

work=$folder/work
rm -rf "$work" "$folder/stamp" "$folder/src" "$folder"/lmp "$folder"/liblammps.so*
mkdir -p "$work"
trap 'rm -rf "$work"' EXIT

# apt-helper goes through apt's own proxies and refuses a file with another checksum.
echo "fetching $file"
$helper -o APT::Sandbox::User=root download-file "$mirror/pool/main/l/lammps/$file" "$work/$file" \
  "SHA256:$sha256" >"$work/log" 2>&1 || { tail -3 "$work/log"; skip "$file does not come from the mirror"; }
tar -xzf "$work/$file" -C "$work" cmake src lib LICENSE || die "cannot unpack $file"
rm "$work/$file"

echo "building LAMMPS $version with $jobs compilers"
generator=() launcher=()
if command -v ninja >/dev/null; then generator=(-G Ninja); fi
if command -v ccache >/dev/null; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
export CCACHE_BASEDIR=$work CCACHE_NOHASHDIR=1
{
  cmake -S "$work/cmake" -B "$work/build" "${generator[@]}" "${launcher[@]}" "${options[@]}" \
    -D CMAKE_CXX_FLAGS="$flags" -D CMAKE_BUILD_RPATH_USE_ORIGIN=on </dev/null &&
    cmake --build "$work/build" -j "$jobs" --target lmp </dev/null
} >"$work/log" 2>&1 || { tail -40 "$work/log" >&2; die "LAMMPS $version does not build"; }

# What is kept: the program, its library beside it, and the headers.
cp -P "$work"/build/liblammps.so* "$work/build/lmp" "$folder"
mkdir "$folder/src"
(cd "$work/src" && find . -name '*.h' -exec cp --parents -t "$folder/src" {} + &&
  cp -r nlohmann "$folder/src")
echo "$stamp" >"$folder/stamp"
echo "$folder"
