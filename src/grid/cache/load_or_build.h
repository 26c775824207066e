// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid from its cache file, or a new one that is kept there for the next start.
#pragma once

#include "grid/triangle_grid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace lsdcd {

// Where a grid goes: memory of one process, or of several that call load_or_build_grid()
// together. The first of them reads and writes the cache file, and builds.
class GridPlace {
 public:
  virtual ~GridPlace() = default;

  virtual bool is_first() const { return true; }
  virtual bool builds() const { return true; }    // this process has the mesh and fills the memory

  // All processes call these together.

  // Runs `work` where `here`. An exception is thrown on all processes.
  virtual void run(bool here, const std::function<void()> &work)
  {
    if (here) work();
  }
  // Returns the number that the first process has.
  virtual std::uint64_t of_first(std::uint64_t number) { return number; }
  // Memory for a flat block, 64-byte aligned. `bytes` counts where the process builds.
  virtual char *allocate(std::size_t bytes) = 0;
  // The block is filled: where processes build, or if `from_file`, on the first one only.
  virtual void publish(bool /*from_file*/) {}
};

struct LoadedGrid {
  GridReport report;    // on processes that build, and on the first
  bool from_cache = false;

  // On the first process: what was done with the cache file, and what was wrong with it. Empty where
  // there is nothing to say.
  std::string cache_text, cache_warning;
};

// Reads the grid from `cache_file` if that was written for this mesh, these settings and this version,
// else builds it. A file that does not fit is replaced, one that is no grid cache is left alone; a cache
// that cannot be written costs a warning. An empty name: no cache. Throws InputError as build_grid() does.
LoadedGrid load_or_build_grid(const std::string &cache_file, const WeldedMesh &mesh,
                              const GridSettings &settings, bool on_cuda, GridPlace &place);

}    // namespace lsdcd
