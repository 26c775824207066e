// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From a point to its cell: arithmetic, one table, one bit.
#pragma once

#include "backend/bits.h"
#include "grid/triangle_grid.h"

namespace lsdcd {

// The location of a point in the grid. `cell` is the number of the cell in its brick.
struct CellAddress {
  const Brick *brick;    // null: no wall within the cutoff
  std::int32_t cell;
  Vec3 from_centre;    // q - cell centre
};

// `cell`: its number in the brick that has the layer.
LSDCD_FN bool has_entries(const BrickLayer &layer, int cell)
{
  return (layer.mask >> (cell & 63)) & 1u;
}
LSDCD_FN bool has_entries(const Brick &brick, int cell)
{
  return has_entries(brick.layer[cell >> 6], cell);
}

// Index of an occupied cell in CellListsView::cells.
LSDCD_FN std::uint32_t cell_index(const BrickLayer &layer, int cell)
{
  const std::uint64_t before = layer.mask & ((std::uint64_t(1) << (cell & 63)) - 1);
  return layer.first_cell + static_cast<std::uint32_t>(count_bits(before));
}
LSDCD_FN std::uint32_t cell_index(const Brick &brick, int cell)
{
  return cell_index(brick.layer[cell >> 6], cell);
}

// The location of a point before any table is read: its cell of the whole grid, and its
// coordinates in cells.
struct CellIndex {
  bool inside;    // false: outside the grid, or not a number; the rest is not set
  std::int32_t i, j, k;
  Vec3 at;
};

LSDCD_FN CellIndex cell_index_of(const GridView &grid, const Vec3 &q)
{
  CellIndex p;
  p.at.x = (q.x - grid.origin.x) * grid.inv_length;
  p.at.y = (q.y - grid.origin.y) * grid.inv_length;
  p.at.z = (q.z - grid.origin.z) * grid.inv_length;
  // Written so that NaN is outside.
  p.inside = p.at.x >= 0 && p.at.y >= 0 && p.at.z >= 0 && p.at.x < grid.n_bricks[0] * kBrickSide &&
             p.at.y < grid.n_bricks[1] * kBrickSide && p.at.z < grid.n_bricks[2] * kBrickSide;
  if (!p.inside) return p;
  p.i = static_cast<int>(p.at.x);
  p.j = static_cast<int>(p.at.y);
  p.k = static_cast<int>(p.at.z);
  return p;
}

// Returns the index in the table of the brick of cell (i, j, k): formula (3) of the paper, for bricks.
LSDCD_FN std::size_t brick_index(const GridView &grid, int i, int j, int k)
{
  return (static_cast<std::size_t>(k >> 3) * grid.n_bricks[1] + (j >> 3)) * grid.n_bricks[0] +
         (i >> 3);
}
LSDCD_FN std::size_t brick_index(const GridView &grid, const CellIndex &p)
{
  return brick_index(grid, p.i, p.j, p.k);
}

// Returns the number of a cell in its brick: formula (3) once more, in bits, as a side has 8 cells.
LSDCD_FN std::int32_t cell_in_brick(int i, int j, int k)
{
  return ((k & 7) << 6) | ((j & 7) << 3) | (i & 7);
}
LSDCD_FN std::int32_t cell_in_brick(const CellIndex &p)
{
  return cell_in_brick(p.i, p.j, p.k);
}

// Returns the brick of a cell of the grid; null where no wall is near.
LSDCD_FN const Brick *brick_at(const GridView &grid, int i, int j, int k)
{
  const std::int32_t b = grid.lists.brick_of[brick_index(grid, i, j, k)];
  return b < 0 ? nullptr : grid.lists.bricks + b;
}

// Length.
LSDCD_FN Vec3 from_cell_centre(const GridView &grid, const CellIndex &p)
{
  const Real half = Real(0.5);
  return grid.length * Vec3{p.at.x - p.i - half, p.at.y - p.j - half, p.at.z - p.k - half};
}

LSDCD_FN CellAddress locate(const GridView &grid, const Vec3 &q)
{
  const CellIndex p = cell_index_of(grid, q);
  if (!p.inside) return {nullptr, 0, {0, 0, 0}};
  const Brick *brick = brick_at(grid, p.i, p.j, p.k);
  if (!brick) return {nullptr, 0, {0, 0, 0}};
  return {brick, cell_in_brick(p), from_cell_centre(grid, p)};
}

// The cell that holds q, and where q is in it. False: it has no entries; `cell` is not set then.
LSDCD_FN bool find_cell(const GridView &grid, const Vec3 &q, CellAddress &at, Cell &cell)
{
  at = locate(grid, q);
  if (!at.brick || !has_entries(*at.brick, at.cell)) return false;
  cell = grid.lists.cells[cell_index(*at.brick, at.cell)];
  return true;
}

}    // namespace lsdcd
