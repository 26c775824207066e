// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's function 1: every cell of the whole grid tries every triangle.
#pragma once

#include "geometry/closest_point.h"
#include "geometry/primitive_distance.h"
#include "grid/lookup/grid_on.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lsdcd {

inline std::size_t all_cells(const TriangleGrid &grid)
{
  return std::size_t(grid.n_bricks[0]) * grid.n_bricks[1] * grid.n_bricks[2] * kBrickCells;
}

// Finds the nearest triangle of n cells, every stride-th of the grid; returns what that
// takes in milliseconds, without copies.
template <class B>
double brute_force_ms(B &b, const TriangleGrid &grid, std::size_t n, std::size_t stride)
{
  const GridOn<B> on(b, FlatGrid(grid));
  const GridView view = on.view;
  const std::uint32_t n_faces = static_cast<std::uint32_t>(grid.wall.faces.size());
  // No launch of a GPU shall take long.
  const std::size_t run = std::max<std::size_t>(1, (std::size_t(1) << 36) / n_faces);
  typename B::template Array<std::uint32_t> nearest(std::min(n, run));
  std::uint32_t *out = nearest.data();
  const std::size_t nx = std::size_t(grid.n_bricks[0]) * kBrickSide,
                    ny = std::size_t(grid.n_bricks[1]) * kBrickSide;
  return b.milliseconds([&] {
    for (std::size_t from = 0; from < n; from += run)
      b.for_each(std::min(run, n - from), [=] LSDCD_LAMBDA(std::size_t k) {
        const std::size_t cell = (from + k) * stride;
        const Real half = Real(0.5);
        const Vec3 centre =
            view.origin +
            view.length * Vec3{cell % nx + half, cell / nx % ny + half, cell / nx / ny + half};
        Real least = kAnyDistance;
        std::uint32_t which = 0;
        for (std::uint32_t face = 0; face < n_faces; face++) {
          const Real d = triangle_distance(view.wall, face, centre);
          if (!(d < least)) continue;
          least = d;
          which = face;
        }
        out[k] = which;
      });
  });
}

}    // namespace lsdcd
