#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Checks that clang-format 14 leaves C++ and CUDA sources as they are; other versions break some lines elsewhere.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
for format in clang-format-14 clang-format ""; do
  if [ -z "$format" ]; then echo "skipped: no clang-format 14"; exit 77; fi
  if $format --version 2>/dev/null | grep -q ' version 14\.'; then break; fi
done
mapfile -t files < <(git ls-files 'src/*' 'kokkos/*' 'tests/*' 'bench/*' 2>/dev/null | grep -E '\.(h|cpp|cu|cuh)$')
[ ${#files[@]} -gt 0 ] || { echo "skipped: not a git checkout"; exit 77; }
$format --dry-run -Werror "${files[@]}" || { echo "$format -i mends it"; exit 1; }
