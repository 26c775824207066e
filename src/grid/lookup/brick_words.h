// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid's brick table as bits: the paper's cube has a table of 1 MB and 66 kB of these,
// which stay next to the processor. Most spheres of a scene need no more.
#pragma once

#include "grid/lookup/locate.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// For 32 indices of the table: a bit for each that has a brick, and how many bricks come before them.
// Bricks are numbered in the order of their indices, so that these two give its number.
struct alignas(8) BrickWord {
  std::uint32_t bits, below;
};

// Has this index of the table a brick? `word` is the index's word.
LSDCD_FN bool has_brick(const BrickWord &word, std::size_t index)
{
  return word.bits >> (index % 32) & 1u;
}
LSDCD_FN std::uint32_t brick_number(const BrickWord &word, std::size_t index)
{
  const std::uint32_t before = word.bits & ((1u << (index % 32)) - 1);
  return word.below + static_cast<std::uint32_t>(count_bits(before));
}

// All words of a grid; the view is on the host.
inline std::vector<BrickWord> brick_words(const GridView &grid)
{
  const std::size_t n = std::size_t(grid.n_bricks[0]) * grid.n_bricks[1] * grid.n_bricks[2];
  std::vector<BrickWord> words((n + 31) / 32, BrickWord{0, 0});
  std::uint32_t bricks = 0;
  for (std::size_t at = 0; at < n; at++) {
    if (at % 32 == 0) words[at / 32].below = bricks;
    if (grid.lists.brick_of[at] < 0) continue;
    words[at / 32].bits |= 1u << (at % 32);
    bricks++;
  }
  return words;
}

// The table by its words, borrowed. A backend may have it elsewhere too, in a type that is asked
// in the same way.
struct BrickTable {
  const BrickWord *words = nullptr;
  std::uint32_t n_words = 0, n_bricks = 0;

  BrickTable() = default;
  // `words`: a copy of those of the CPU, where they are asked for.
  BrickTable(const std::vector<BrickWord> &host, const BrickWord *words) :
      words(words), n_words(static_cast<std::uint32_t>(host.size()))
  {
    if (!host.empty())
      n_bricks = host.back().below + static_cast<std::uint32_t>(count_bits(host.back().bits));
  }

  LSDCD_FN bool at(std::uint32_t index) const { return has_brick(words[index / 32], index); }
  LSDCD_FN BrickWord word(std::uint32_t index) const { return words[index / 32]; }
};

constexpr std::uint32_t kNoBrick = 0xffffffffu;

// A point's brick by its index in the table, and the number of its cell in the brick.
struct BrickIndex {
  std::uint32_t index;    // kNoBrick: outside of the grid, or not a number
  std::int32_t cell;
};

// Returns what cell_index_of() finds, to the bit, without a branch: a thread has several points at once, and would wait
// for the words of one after the other. Tables have less than 2^32 indices.
LSDCD_FN BrickIndex brick_index_of(const GridView &grid, const Vec3 &q)
{
  const WholeNumber i = whole_below((q.x - grid.origin.x) * grid.inv_length),
                    j = whole_below((q.y - grid.origin.y) * grid.inv_length),
                    k = whole_below((q.z - grid.origin.z) * grid.inv_length);
  const std::uint32_t nx = grid.n_bricks[0], ny = grid.n_bricks[1], nz = grid.n_bricks[2];
  const bool inside = i.fits & j.fits & k.fits & ((i.value >> 3) < nx) & ((j.value >> 3) < ny) &
                      ((k.value >> 3) < nz);
  const std::uint32_t index = ((k.value >> 3) * ny + (j.value >> 3)) * nx + (i.value >> 3);
  return {inside ? index : kNoBrick, cell_in_brick(i.value, j.value, k.value)};
}

// The address that locate() gives, to the bit, without its brick, which nothing needs once the
// list of the cell is known; for a point that is inside of the grid.
LSDCD_FN CellAddress address_inside(const GridView &grid, const Vec3 &q)
{
  const Vec3 at = {(q.x - grid.origin.x) * grid.inv_length, (q.y - grid.origin.y) * grid.inv_length,
                   (q.z - grid.origin.z) * grid.inv_length};
  const WholeNumber i = whole_below(at.x), j = whole_below(at.y), k = whole_below(at.z);
  const Real half = Real(0.5);
  return {nullptr, cell_in_brick(i.value, j.value, k.value),
          grid.length * Vec3{at.x - i.real - half, at.y - j.real - half, at.z - k.real - half}};
}

constexpr std::uint32_t kNoCell = 0xffffffffu;

// Index in lists.cells of the cell that holds q; kNoCell where it has no entries, as find_cell()
// says. `table`: as BrickTable.
template <class Table>
LSDCD_FN std::uint32_t occupied_cell(const GridView &grid, const Table &table, const Vec3 &q)
{
  const BrickIndex at = brick_index_of(grid, q);
  const BrickWord word = at.index != kNoBrick ? table.word(at.index) : BrickWord{0, 0};
  BrickLayer layer = {0, 0, 0};
  if (has_brick(word, at.index))
    layer = grid.lists.bricks[brick_number(word, at.index)].layer[at.cell >> 6];
  return has_entries(layer, at.cell) ? cell_index(layer, at.cell) : kNoCell;
}

}    // namespace lsdcd
