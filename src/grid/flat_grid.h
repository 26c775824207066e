// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid as one flat block in memory of its own, aligned as views require. Moving a FlatGrid leaves
// the block where it is.
#pragma once

#include "backend/owned_array.h"
#include "base/large_memory.h"
#include "grid/triangle_grid.h"

namespace lsdcd {

class FlatGrid {
 public:
  FlatGrid() = default;
  explicit FlatGrid(const TriangleGrid &grid) : FlatGrid(flat_bytes(grid))
  {
    flatten(grid, block());
  }
  explicit FlatGrid(const GridParts &grid) : FlatGrid(flat_bytes(grid)) { flatten(grid, block()); }
  // Allocates a block that the caller fills.
  explicit FlatGrid(std::size_t bytes) : memory_(bytes) {}

  char *block() { return memory_.data(); }
  std::size_t bytes() const { return memory_.size(); }
  GridView view() const { return flat_view(memory_.data()); }

 private:
  OwnedArray<char, LargeMemory> memory_;
};

// A flat grid whose type says for what it was built, as FlatOf<StepGrid>.
template <class Grid>
class FlatOf : public FlatGrid {
 public:
  FlatOf() = default;
  explicit FlatOf(const Grid &grid) : FlatGrid(grid) {}
  ViewOf<Grid> view() const { return ViewOf<Grid>(FlatGrid::view()); }
};

}    // namespace lsdcd
