// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// In place of grid_cache.cpp and grid_key.cpp where zstd or xxHash is missing.
#include "base/input_error.h"
#include "grid/cache/grid_cache.h"

namespace lsdcd {

namespace {

constexpr const char *kWhy =
    "this build has no grid cache: install zstd and xxHash (Debian: libzstd-dev, libxxhash-dev) "
    "and build again";

}    // namespace

bool cache_available(std::string *why)
{
  if (why) *why = kWhy;
  return false;
}

GridKey grid_key(const WeldedMesh &, const GridSettings &)
{
  throw InputError(kWhy);
}

CachedGrid::CachedGrid(const std::string &, const GridKey &)
{
  throw InputError(kWhy);
}
CachedGrid::~CachedGrid() {}

bool CachedGrid::read(char *)
{
  throw InputError(kWhy);
}

std::size_t write_grid_cache(const std::string &, const GridKey &, const GridReport &, const char *,
                             std::size_t)
{
  throw InputError(kWhy);
}

}    // namespace lsdcd
