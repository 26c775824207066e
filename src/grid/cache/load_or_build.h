// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid from its cache file, or a new one that is stored there for the next start.
#pragma once

#include "grid/triangle_grid.h"
#include "host/host.h"

#include <string>

namespace lsdcd {

struct LoadedGrid {
  GridReport report;    // on processes that fill memory
  bool from_cache = false;

  // On the first process: what was done with the cache file, and what was wrong with it. Empty where
  // there is nothing to say.
  std::string cache_text, cache_warning;
};

// Reads the grid from `cache_file` if that was written for this mesh, these settings and this version,
// else builds it. A file that does not fit is replaced, one that is no grid cache is left alone; a cache
// that cannot be written costs a warning. An empty name: no cache. `memory` gets the flat block, in place of what it
// had. Processes that fill memory have the mesh and build; the first has the file, which other nodes may not see.
// Throws InputError as build_grid() does. Collective.
LoadedGrid load_or_build_grid(const std::string &cache_file, const WeldedMesh &mesh,
                              const AnyGridSettings &settings, bool on_cuda, Host &host,
                              NodeMemory &memory);

}    // namespace lsdcd
