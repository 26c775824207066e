#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# The source tarball: whole, and the same each time.
#   test_tarball.sh CMAKE PYTHON     of the checkout that this file is in
set -uo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cmake=$1 python=$2
status=0
fact() { if "${@:2}"; then echo "PASS $1"; else echo "FAIL $1"; status=1; fi; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/first" "$work/second"

"$top/cmake/source_tarball.sh" "$work/first" || exit
TZ=Asia/Tokyo LC_ALL=C "$top/cmake/source_tarball.sh" "$work/second"
tarball=$(ls "$work"/first/*.tar.gz)
fact "two of one commit are the same bytes" cmp "$tarball" "$work/second/$(basename "$tarball")"

mkdir "$work/use"
cd "$work/use"
tar -xzf "$tarball"
cd -- *
fact "its folder has its name" test "$(basename "$PWD").tar.gz" = "$(basename "$tarball")"
fact "it has every file of the commit" diff <(find . -type f -printf '%P\n' | sort) \
  <(git -C "$top" ls-tree -r --name-only HEAD | sort)
fact "versions in it agree" "$python" tests/tool/check_release.py
quiet() { "$@" >"$work/log" 2>&1 || { tail -20 "$work/log"; false; }; }
fact "it configures" quiet "$cmake" -S . -B build -D LSDCD_TESTS=OFF -D LSDCD_LAMMPS=OFF -D LSDCD_CUDA=OFF
commit=$(git -C "$top" rev-parse HEAD)
fact "what is built of it will name the commit" grep -rqF "LSDCD_COMMIT=\\\"${commit:0:10}\\\"" build --include=flags.make --include=build.ninja

# commit_of FOLDER: what a build of the sources there would name.
printf 'include(%s/cmake/Commit.cmake)\nmessage(STATUS "[${LSDCD_COMMIT}]")\n' "$top" >"$work/commit.cmake"
commit_of() { "$cmake" -D PROJECT_SOURCE_DIR="$1" -P "$work/commit.cmake" | sed 's/.*\[\(.*\)\].*/\1/'; }
git init -q "$work/other"
git -C "$work/other" -c user.name=me -c user.email=me@here commit -q --allow-empty -m first
mkdir "$work/other/lsdcd"
fact "a copy without git names no commit of the checkout around it" test -z "$(commit_of "$work/other/lsdcd")"
short=$(git -C "$work/other" describe --always)
fact "a checkout of another user names its commit" \
  test "$(GIT_TEST_ASSUME_DIFFERENT_OWNER=1 commit_of "$work/other")" = "$short"
exit $status
