// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid's brick table once more, a bit for a cube of bricks: so small that each block of a GPU's
// threads can have it. Most spheres of a scene need no more.
#pragma once

#include "grid/triangle_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

struct CoarseTable {
  static constexpr std::uint32_t kWords = 128;

  const std::uint32_t *words = nullptr;    // kWords, x fastest; borrowed
  std::uint32_t shift = 0;                 // a cube has 2^shift bricks along an edge
  std::uint32_t n[3] = {1, 1, 1};          // cubes

  CoarseTable() = default;
  // The smallest cubes that there are bits for.
  explicit CoarseTable(const GridView &grid)
  {
    const auto count = [&] {
      std::size_t all = 1;
      for (int a = 0; a < 3; a++) {
        n[a] = (static_cast<std::uint32_t>(grid.n_bricks[a]) + (1u << shift) - 1) >> shift;
        all *= n[a];
      }
      return all;
    };
    while (count() > std::size_t(kWords) * 32) shift++;
  }

  // Returns the index of the cube with these numbers, z first.
  LSDCD_FN std::uint32_t index(std::uint32_t k, std::uint32_t j, std::uint32_t i) const
  {
    return (k * n[1] + j) * n[0] + i;
  }
  LSDCD_FN static bool at(const std::uint32_t *words, std::uint32_t index)
  {
    return words[index / 32] >> index % 32 & 1u;
  }
};

// Returns the bits of a table for a view on the host.
inline std::vector<std::uint32_t> coarse_words(const GridView &grid, const CoarseTable &table)
{
  std::vector<std::uint32_t> words(CoarseTable::kWords, 0);
  std::size_t at = 0;
  for (std::int32_t k = 0; k < grid.n_bricks[2]; k++)
    for (std::int32_t j = 0; j < grid.n_bricks[1]; j++)
      for (std::int32_t i = 0; i < grid.n_bricks[0]; i++, at++) {
        if (grid.lists.brick_of[at] < 0) continue;
        const std::uint32_t index =
            table.index(k >> table.shift, j >> table.shift, i >> table.shift);
        words[index / 32] |= 1u << index % 32;
      }
  return words;
}

}    // namespace lsdcd
