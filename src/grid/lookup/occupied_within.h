// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Could a point be near the wall once it has moved a little?
#pragma once

#include "grid/lookup/brick_words.h"

namespace lsdcd {

// The cells [lo, hi) along one side of the grid in which a point at `u` (in cells) may be
// after a way of up to `margin` cells.
LSDCD_FN void cells_within(Real u, Real margin, std::int32_t n_cells, int &lo, int &hi)
{
  const Real from = floor(u - margin), to = floor(u + margin) + 1;
  lo = from > 0 ? (from < n_cells ? static_cast<int>(from) : n_cells) : 0;
  hi = to > 0 ? (to < n_cells ? static_cast<int>(to) : n_cells) : 0;
}

// The cells that a point at q may be in after a way of length up to `margin`, [lo, hi) along each
// axis. A cell is left out only if it is out of reach after rounding, too. False: there is none,
// or q is not finite.
LSDCD_FN bool cells_in_ball(const GridView &grid, const Vec3 &q, Real margin, int *lo, int *hi)
{
  const Real cells = margin * grid.inv_length * (1 + 8 * kRoundoff) + Real(1e-9);
  for (int d = 0; d < 3; d++) {
    const Real u = (q[d] - grid.origin[d]) * grid.inv_length;
    if (!(fabs(u) < Real(1e9))) return false;
    cells_within(u, cells, grid.n_bricks[d] * kBrickSide, lo[d], hi[d]);
    if (lo[d] >= hi[d]) return false;
  }
  return true;
}

// The part of a margin that is beyond the lists' own margin.
LSDCD_FN Real excess_margin(const GridView &grid, Real margin)
{
  return margin > grid.margin ? margin - grid.margin : Real(0);
}

// Has any cell that a point at q may be in after moving at most `margin` (length) an entry?
// With margin 0 that is the cell of q. False if q is not finite. `table`: with the functions
// of BrickTable.
template <class Table>
LSDCD_FN bool occupied_within(const GridView &grid, const Table &table, const Vec3 &q, Real margin)
{
  if (!(margin > 0)) return occupied_cell(grid, table, q) != kNoCell;
  int lo[3], hi[3];
  if (!cells_in_ball(grid, q, margin, lo, hi)) return false;
  // Brick by brick, layer by layer: one word of the mask each.
  for (int bz = lo[2] >> 3; bz <= (hi[2] - 1) >> 3; bz++)
    for (int by = lo[1] >> 3; by <= (hi[1] - 1) >> 3; by++)
      for (int bx = lo[0] >> 3; bx <= (hi[0] - 1) >> 3; bx++) {
        const std::uint32_t at =
            (static_cast<std::uint32_t>(bz) * grid.n_bricks[1] + by) * grid.n_bricks[0] + bx;
        const BrickWord word = table.word(at);
        if (!has_brick(word, at)) continue;
        const Brick &brick = grid.lists.bricks[brick_number(word, at)];
        const int x0 = lo[0] > 8 * bx ? lo[0] - 8 * bx : 0;
        const int x1 = hi[0] < 8 * bx + 8 ? hi[0] - 8 * bx : 8;
        const int y0 = lo[1] > 8 * by ? lo[1] - 8 * by : 0;
        const int y1 = hi[1] < 8 * by + 8 ? hi[1] - 8 * by : 8;
        const std::uint64_t row = ((std::uint64_t(1) << (x1 - x0)) - 1) << x0;
        std::uint64_t layer = 0;
        for (int y = y0; y < y1; y++) layer |= row << (8 * y);
        const int z0 = lo[2] > 8 * bz ? lo[2] - 8 * bz : 0;
        const int z1 = hi[2] < 8 * bz + 8 ? hi[2] - 8 * bz : 8;
        for (int z = z0; z < z1; z++)
          if (brick.layer[z].mask & layer) return true;
      }
  return false;
}

}    // namespace lsdcd
