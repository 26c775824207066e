// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where the cells of a grid will be and how much memory it will take.
#pragma once

#include "base/vec3.h"
#include "grid/triangle_grid.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// Margin of complete lists. With it, one cell nearly always has all that a sphere can touch until
// its list of the wall is made again.
constexpr Real cell_margin(Real cutoff)
{
  return Real(0.05) * cutoff;
}

// Returns the tolerance of the lists of a mesh, whose box has this diagonal. It covers the regions that flat edges leave
// out (four times their largest angle, times the cutoff) and the rounding of dot products over a whole face.
constexpr Real list_tolerance(Real cutoff, Real diagonal)
{
  return 4e-13 * cutoff + 16 * kRoundoff * (diagonal + cutoff);
}

// Bricks of a table, at most: keys of octants have 32 bits.
constexpr double kMostBricks = 5e8;

struct GridPlan {
  Vec3 origin;
  Real length, half_diagonal;    // half a cell's diagonal; the second with room for rounding
  Real cutoff, tolerance;
  Real margin;          // a list is valid so far past its cell
  Real least_volume;    // lower bound of the volume within the cutoff of the wall
  std::int32_t n_bricks[3];

  // Returns the number of bricks in the box, by formula (2) of the paper: its volume over that of a brick.
  std::size_t table_size() const { return std::size_t(n_bricks[0]) * n_bricks[1] * n_bricks[2]; }
  // Lower bound of the bytes: of the table, or of the bricks that the least volume needs. Infinite if
  // bricks cannot be numbered.
  double least_bytes() const;

  // By how much the tests of complete lists are widened.
  LSDCD_FN Real widened() const { return tolerance + margin; }

  LSDCD_FN Vec3 brick_centre(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const Real side = kBrickSide * length, half = Real(0.5);
    return origin + side * Vec3{x + half, y + half, z + half};
  }
};

// The centres of a brick's cells, by the brick's index in the table.
struct CellCentres {
  Vec3 origin;
  Real length;
  std::uint32_t x, y, z;    // of the brick's first cell

  LSDCD_FN CellCentres(const GridPlan &plan, std::uint32_t index) :
      origin(plan.origin), length(plan.length)
  {
    const std::uint32_t nx = plan.n_bricks[0], ny = plan.n_bricks[1];
    x = index % nx * kBrickSide;
    y = index / nx % ny * kBrickSide;
    z = index / nx / ny * kBrickSide;
  }
  LSDCD_FN Vec3 at(int cell) const
  {
    const Real half = Real(0.5);
    return origin +
           length * Vec3{x + (cell & 7) + half, y + (cell >> 3 & 7) + half, z + (cell >> 6) + half};
  }
};

// Returns the default length of a cell by cutoff, purpose, nearest and for_gpu.
Real default_length(const WeldedMesh &mesh, const AnyGridSettings &settings);

// From the settings; if these have no length, it follows from the mesh and the cutoff.
GridPlan plan_grid(const WeldedMesh &mesh, const AnyGridSettings &settings);

constexpr Real kCoarser = 1.25;

// The next coarser plan of a search for one that fits, until a cell is larger than the mesh.
bool is_coarsest(const GridPlan &plan, const WeldedMesh &mesh);
GridPlan coarser(const GridPlan &plan, const WeldedMesh &mesh, const GridSettings &settings);

// Bytes of the finished arrays, and of the bricks while they are built.
std::size_t grid_bytes(const GridPlan &plan, std::size_t bricks, std::size_t cells,
                       std::size_t entries);
std::size_t brick_bytes(const GridPlan &plan, std::size_t bricks);

// `needed`: the bytes that a grid of the given length takes at least, or, if the length is chosen, those
// of the coarsest grid.
[[noreturn]] void throw_over_budget(const GridSettings &settings, double needed, double budget);
// A given length whose build takes so many times what BuildLimit allows.
[[noreturn]] void throw_over_limit(const GridSettings &settings, double times);

}    // namespace lsdcd
