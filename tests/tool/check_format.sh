#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Checks that clang-format leaves C++ and CUDA sources as they are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
command -v clang-format >/dev/null || { echo "skipped: no clang-format"; exit 77; }
mapfile -t files < <(git ls-files 'src/*' 'kokkos/*' 'tests/*' 'bench/*' 2>/dev/null | grep -E '\.(h|cpp|cu|cuh)$')
[ ${#files[@]} -gt 0 ] || { echo "skipped: not a git checkout"; exit 77; }
clang-format --dry-run -Werror "${files[@]}" || { echo "clang-format -i mends it"; exit 1; }
