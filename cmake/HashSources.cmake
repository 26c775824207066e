# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

# Writes a header with a hash of the sources that decide what is in a grid, so that
# a cache file made by others is not used.
#   cmake -D ROOT=dir -D SOURCES=a,b,... -D OUT=header -P HashSources.cmake
string(REPLACE "," ";" sources "${SOURCES}")
set(all "")
foreach(source ${sources})
  file(SHA256 ${ROOT}/${source} one)
  string(APPEND all "${source} ${one}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${OUT} "// Made by cmake/HashSources.cmake.
#pragma once

#include <cstdint>

namespace lsdcd {
constexpr std::uint64_t kGridSources = 0x${hash};
}
")
