#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: GPL-2.0-only

# Compiles the fix, plugin and launcher against the headers of newer LAMMPS packages.
#   compile_hosts.sh [SUITE ...]    default: trixie and sid
# The headers come from Debian through an apt configuration of their own, from the
# mirror that this machine's apt already uses, into a cache folder.
# Prints PASS, FAIL or SKIPPED for each host; exits 1 on FAIL, 77 if all were skipped.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$root/tests/lammps/hosts/debian_mirror.sh"
cache=${LSDCD_HOSTS:-${XDG_CACHE_HOME:-$HOME/.cache}/lsdcd/hosts}
cxx=${LSDCD_CXX:-c++}
log=$(mktemp)
trap 'rm -rf "$log" "$objects"' EXIT
objects=$(mktemp -d)

# apt-get with its own lists and sources; the system's stay as they are. A list past its term is
# good enough here; its signature is checked all the same.
private_apt() {
  apt-get -q -y -o Dir::Etc::sourcelist="$cache/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null \
    -o Dir::State::Lists="$cache/apt/lists" -o Dir::Cache="$cache/apt/cache" \
    -o APT::Sandbox::User=root -o Acquire::Check-Valid-Until=false -o Debug::NoLocking=1 "$@" >>"$log" 2>&1
}

# Unpacks liblammps-dev of a suite into $cache/<suite>, or says why not.
get_headers() {
  local suite=$1 folder=$cache/$1 mirror
  [ -d "$folder/usr/include/lammps" ] && return 0
  command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || { echo "no apt here"; return 1; }
  mirror=$(debian_mirror)
  [ -n "$mirror" ] || { echo "apt has no Debian mirror configured"; return 1; }
  mkdir -p "$cache/apt/lists/partial" "$cache/apt/cache/archives/partial" "$cache/apt/deb"
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror $suite main" \
    >"$cache/apt/sources.list"
  private_apt update || { echo "no package list of $suite from the mirror"; return 1; }
  (cd "$cache/apt/deb" && rm -f ./*.deb && private_apt download liblammps-dev) ||
    { echo "liblammps-dev of $suite does not download"; return 1; }
  mkdir -p "$folder" && dpkg-deb -x "$cache"/apt/deb/liblammps-dev_*.deb "$folder"
}

compile() {
  local headers=$1 version=$2 shims=() file
  [ -e "$headers/fmt/format.h" ] || shims+=(-I "$root/cmake/compat/no_fmt")
  [ -e "$headers/command.h" ] || shims+=(-I "$root/cmake/compat/no_command")
  [ -e "$headers/safe_pointers.h" ] || shims+=(-I "$root/cmake/compat/no_safe_pointers")
  for file in "$root"/src/lammps/{*,launcher/*}.cpp; do
    # shellcheck disable=SC2046
    $cxx -std=c++17 -Wall -Wextra -Werror -fPIC -DLAMMPS_SMALLBIG -DLSDCD_HOST_VERSION="$version" -DLSDCD_PLUGINS='"lib"' -DLSDCD_STYLES='"styles.so"' \
      -DOMPI_SKIP_MPICXX $(mpicxx --showme:compile) -I "$root/src" "${shims[@]}" \
      -isystem "$headers" -c "$file" -o "$objects/object.o" >>"$log" 2>&1 || return 1
  done
}

failed=0 tried=0
[ $# -gt 0 ] || set -- trixie sid
for suite in "$@"; do
  if ! why=$(get_headers $suite); then
    echo "SKIPPED headers of $suite: $why"
    continue
  fi
  # "20250204", later "2026.7.4.0"
  version=$(awk -F'"' '/^set\(PACKAGE_VERSION / {
      n = split($2, part, "."); print (n > 1 ? part[1] * 10000 + part[2] * 100 + part[3] : $2)
    }' "$cache/$suite"/usr/lib/*/cmake/LAMMPS/LAMMPSConfigVersion.cmake)
  tried=1
  if compile "$cache/$suite/usr/include/lammps" "$version"; then
    echo "PASS compiles against LAMMPS $version ($suite)"
  else
    echo "FAIL compiles against LAMMPS $version ($suite)"
    tail -40 "$log"
    failed=1
  fi
done
[ $failed -eq 0 ] || exit 1
[ $tried -eq 1 ] || exit 77
