// From a point to its cell: arithmetic, one table, one bit.
#pragma once

#include "grid/triangle_grid.h"

namespace lsdcd {

// Where a point falls in the grid. `cell` is the cell's number in its brick.
struct CellAddress {
  const Brick *brick;    // null: no wall within reach
  std::int32_t cell;
  Vec3 from_centre;    // q - cell centre
};

LSDCD_FN int count_bits(std::uint64_t word)
{
#if defined(__CUDA_ARCH__)
  return __popcll(word);
#else
  return __builtin_popcountll(word);
#endif
}

LSDCD_FN bool has_candidates(const Brick &brick, int cell)
{
  return (brick.mask[cell >> 6] >> (cell & 63)) & 1u;
}

// Index of an occupied cell in CellListsView::cells.
LSDCD_FN std::uint32_t cell_index(const Brick &brick, int cell)
{
  const int word = cell >> 6;
  const std::uint64_t before = brick.mask[word] & ((std::uint64_t(1) << (cell & 63)) - 1);
  return brick.first_cell + brick.below[word] + static_cast<std::uint32_t>(count_bits(before));
}

LSDCD_FN CellAddress locate(const GridView &grid, const CellListsView &lists, const Vec3 &q)
{
  const Real u = (q.x - grid.origin.x) * grid.inv_length;
  const Real v = (q.y - grid.origin.y) * grid.inv_length;
  const Real w = (q.z - grid.origin.z) * grid.inv_length;
  // Written so that a NaN falls outside.
  if (!(u >= 0 && v >= 0 && w >= 0)) return {nullptr, 0, {0, 0, 0}};
  if (!(u < grid.n_bricks[0] * kBrickSide && v < grid.n_bricks[1] * kBrickSide &&
        w < grid.n_bricks[2] * kBrickSide))
    return {nullptr, 0, {0, 0, 0}};
  const int i = static_cast<int>(u), j = static_cast<int>(v), k = static_cast<int>(w);
  const std::size_t at =
      (static_cast<std::size_t>(k >> 3) * grid.n_bricks[1] + (j >> 3)) * grid.n_bricks[0] +
      (i >> 3);
  const std::int32_t b = lists.brick_of[at];
  if (b < 0) return {nullptr, 0, {0, 0, 0}};
  const Real half = Real(0.5);
  return {lists.bricks + b, ((k & 7) << 6) | ((j & 7) << 3) | (i & 7),
          grid.length * Vec3{u - i - half, v - j - half, w - k - half}};
}

LSDCD_FN bool near_wall(const GridView &grid, const Vec3 &q)
{
  const CellAddress at = locate(grid, grid.lists, q);
  return at.brick && has_candidates(*at.brick, at.cell);
}

}    // namespace lsdcd
