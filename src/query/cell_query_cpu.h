// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A query on the CPU, in blocks of spheres. It first finds the spheres that may be in a brick, then
// their cells, then their lists, and last the answers. Each loop prefetches what the next one reads,
// so that no sphere waits for the memory of another.
#pragma once

#include "grid/lookup/brick_words.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace lsdcd {

struct CellQueryCpu {
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
  struct InCell {
    S s;
    std::size_t sphere;
    std::uint32_t index, cell;    // cell: its number in its brick, then in lists.cells
  };

  template <class Work>
  [[gnu::noinline]] static void run_block(const Work &work, std::size_t from, std::size_t to)
  {
    using S = typename Work::Item;
    const GridView &grid = work.grid;
    InCell<S> in_cell[kBlock];
    std::size_t n = 0;
    // Written whether it is in a brick or not: a branch would often be mispredicted.
    for (std::size_t i = from; i < to; i++) {
      const S s = work.sphere(i);
      work.check(i, s);
      const BrickIndex at = brick_index_of(grid, s.centre());
      in_cell[n] = {s, i, at.index, static_cast<std::uint32_t>(at.cell)};
      n += at.index != kNoBrick && work.table.at(at.index);
      work.far(i, s);
    }
    for (std::size_t k = 0; k < n; k++) __builtin_prefetch(grid.lists.brick_of + in_cell[k].index);
    for (std::size_t k = 0; k < n; k++) __builtin_prefetch(layer_of(grid, in_cell[k]));
    std::size_t n_occupied = 0;
    for (std::size_t k = 0; k < n; k++) {
      const BrickLayer &layer = *layer_of(grid, in_cell[k]);
      const int cell = static_cast<int>(in_cell[k].cell);
      if (!has_entries(layer, cell)) continue;
      in_cell[n_occupied] = in_cell[k];
      in_cell[n_occupied].cell = cell_index(layer, cell);
      __builtin_prefetch(grid.lists.cells + in_cell[n_occupied++].cell);
    }
    for (std::size_t k = 0; k < n_occupied; k++) prefetch_list(grid, *work.list(in_cell[k].cell));
    for (std::size_t k = 0; k < n_occupied; k++)
      work.search_list(in_cell[k].sphere, in_cell[k].s, *work.list(in_cell[k].cell));
  }

  template <class S>
  static const BrickLayer *layer_of(const GridView &grid, const InCell<S> &at)
  {
    return grid.lists.bricks[grid.lists.brick_of[at.index]].layer + (at.cell >> 6);
  }
  static void prefetch_list(const GridView &grid, const Cell &cell)
  {
    if (cell.count > 1)
      __builtin_prefetch(grid.lists.entries + cell.first);
    else if (!grid.in_floats)
      prefetch(grid.wall, cell.first);
  }
};

}    // namespace lsdcd
