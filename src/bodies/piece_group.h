// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Groups of neighbouring pieces, and a test whether any of them can be near the wall.
#pragma once

#include "bodies/subdivide.h"
#include "grid/lookup/locate.h"

#include <cstddef>

namespace lsdcd {

// A ball around the centres of kPiecesOfGroup pieces, mostly of one triangle.
struct PieceGroup {
  Vec3 centre;    // in the body's frame
  Real radius;
};
constexpr std::size_t kPiecesOfGroup = 64;

LSDCD_FN PieceGroup group_of(const Piece *pieces, std::size_t begin, std::size_t end)
{
  Vec3 lo = pieces[begin].centre, hi = lo;
  for (std::size_t i = begin + 1; i < end; i++)
    for (int k = 0; k < 3; k++) {
      lo[k] = fmin(lo[k], pieces[i].centre[k]);
      hi[k] = fmax(hi[k], pieces[i].centre[k]);
    }
  return {Real(0.5) * (lo + hi), Real(0.5) * norm(hi - lo) * (1 + Real(1e-6))};
}

// Is any brick that overlaps a ball's box in the grid? True without a test if these are many.
LSDCD_FN bool any_brick_within(const GridView &grid, const Vec3 &centre, Real radius)
{
  constexpr Real kManyBricks = 4;    // along an axis
  const Real inv = grid.inv_length / kBrickSide, rim = Real(1e-6);
  int first[3], last[3];
  for (int k = 0; k < 3; k++) {
    const Real from = (centre[k] - radius - grid.origin[k]) * inv - rim,
               to = (centre[k] + radius - grid.origin[k]) * inv + rim, n = grid.n_bricks[k];
    if (to < 0 || from >= n) return false;
    if (!(to - from < kManyBricks)) return true;
    first[k] = static_cast<int>(fmax(Real(0), from));
    last[k] = static_cast<int>(fmin(n - 1, to));
  }
  for (int z = first[2]; z <= last[2]; z++)
    for (int y = first[1]; y <= last[1]; y++)
      for (int x = first[0]; x <= last[0]; x++)
        if (brick_at(grid, x * kBrickSide, y * kBrickSide, z * kBrickSide)) return true;
  return false;
}

}    // namespace lsdcd
