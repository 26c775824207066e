// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A query on the CPU in blocks of spheres: first it finds those that may be near the wall, then their
// cells, then their lists, and last the answers. Each loop prefetches what the next one reads, so that
// no sphere waits for the memory of another.
#pragma once

#include "grid/lookup/brick_words.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lsdcd {

struct NearFirstCpu {
  template <class B, class Work>
  void run(B &b, std::size_t n, const Work &work)
  {
    if (n <= kBlock) return run_block(work, 0, n);    // starting threads takes longer
    b.for_each((n + kBlock - 1) / kBlock, [&](std::size_t block) {
      run_block(work, block * kBlock, std::min(n, (block + 1) * kBlock));
    });
  }

 private:
  static constexpr std::size_t kBlock = 128;

  template <class S>
  struct Near {
    S s;
    std::size_t sphere;
    std::uint32_t slot, cell;    // the cell's number in its brick, then in lists.cells
  };

  template <class Work>
  [[gnu::noinline]] static void run_block(const Work &work, std::size_t from, std::size_t to)
  {
    using S = typename Work::Item;
    const GridView &grid = work.grid;
    Near<S> near[kBlock];
    std::size_t n = 0;
    // Written whether it is near or not: a branch would often be mispredicted.
    for (std::size_t i = from; i < to; i++) {
      const S s = work.sphere(i);
      work.check(i, s);
      const BrickSlot at = brick_place_of(grid, s.centre());
      near[n] = {s, i, at.slot, static_cast<std::uint32_t>(at.cell)};
      n += at.slot != kNoBrick && work.table.at(at.slot);
      work.far(i, s);
    }
    for (std::size_t k = 0; k < n; k++) __builtin_prefetch(grid.lists.brick_of + near[k].slot);
    for (std::size_t k = 0; k < n; k++) __builtin_prefetch(layer_of(grid, near[k]));
    std::size_t n_near = 0;
    for (std::size_t k = 0; k < n; k++) {
      const BrickLayer &layer = *layer_of(grid, near[k]);
      const int cell = static_cast<int>(near[k].cell);
      if (!has_candidates(layer, cell)) continue;
      near[n_near] = near[k];
      near[n_near].cell = cell_index(layer, cell);
      __builtin_prefetch(grid.lists.cells + near[n_near++].cell);
    }
    for (std::size_t k = 0; k < n_near; k++) prefetch_list(grid, *work.list(near[k].cell));
    for (std::size_t k = 0; k < n_near; k++)
      work.search_list(near[k].sphere, near[k].s, *work.list(near[k].cell));
  }

  template <class S>
  static const BrickLayer *layer_of(const GridView &grid, const Near<S> &at)
  {
    return grid.lists.bricks[grid.lists.brick_of[at.slot]].layer + (at.cell >> 6);
  }
  static void prefetch_list(const GridView &grid, const Cell &cell)
  {
    if (cell.count > 1)
      __builtin_prefetch(grid.lists.candidates + cell.first);
    else if (!grid.in_floats)
      prefetch(grid.wall, cell.first);
  }
};

}    // namespace lsdcd
