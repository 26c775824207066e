#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# source_tarball.sh FOLDER: writes lsdcd-VERSION.tar.gz of what is committed. The same commit gives the
# same bytes. Exits 77 with a line "skipped: ..." where this is no git checkout.
set -euo pipefail
folder=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ "$(git rev-parse --show-toplevel 2>/dev/null)" != "$PWD" ]; then
  echo "skipped: no source tarball: not a git checkout"
  exit 77
fi
version=$(sed -n 's/^project(lsdcd VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
tarball=$folder/lsdcd-$version.tar.gz
git archive --format=tar --prefix="lsdcd-$version/" HEAD | gzip -9n >"$tarball.part"
mv "$tarball.part" "$tarball"
if [ -n "$(git status --porcelain)" ]; then echo "note: what is not committed is not in $tarball" >&2; fi
