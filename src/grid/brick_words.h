// A grid's brick table as bits: the paper's cube has a table of 1 MB and 66 kB of these,
// which stay next to the processor. Most spheres of a scene need no more.
#pragma once

#include "grid/locate.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// Of 32 places of the table: which have a brick, and how many bricks come before them.
// Bricks are numbered in the order of their places, so that these two give its number.
struct alignas(8) BrickWord {
  std::uint32_t bits, below;
};

// Of the word that has a place of the table.
LSDCD_FN bool has_brick(const BrickWord &word, std::size_t place)
{
  return word.bits >> (place % 32) & 1u;
}
LSDCD_FN std::uint32_t brick_number(const BrickWord &word, std::size_t place)
{
  const std::uint32_t before = word.bits & ((1u << (place % 32)) - 1);
  return word.below + static_cast<std::uint32_t>(count_bits(before));
}

// Of grid.lists, for a view on the host.
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

constexpr std::uint32_t kNoCell = 0xffffffffu;

// Index in grid.lists.cells of the cell that holds q, without the brick table; kNoCell where
// it has no candidates, as where near_wall(grid, q) is false.
LSDCD_FN std::uint32_t occupied_cell(const GridView &grid, const BrickWord *words, const Vec3 &q)
{
  const Place p = place_of(grid, q);
  if (!p.inside) return kNoCell;
  const std::size_t place = brick_place(grid, p);
  const BrickWord word = words[place / 32];
  if (!has_brick(word, place)) return kNoCell;
  const Brick &brick = grid.lists.bricks[brick_number(word, place)];
  const std::int32_t cell = cell_in_brick(p);
  return has_candidates(brick, cell) ? cell_index(brick, cell) : kNoCell;
}

}    // namespace lsdcd
