// Which spheres could be near the wall after a way of up to `margin`, as Backend::select asks:
// what is read of all of them, and what only those in a brick of the grid need.
#pragma once

#include "base/atomic.h"
#include "engine/law_job.h"
#include "grid/near_within.h"

#include <cstdint>

namespace lsdcd {

struct NearChoice {
  GridView grid;
  const BrickWord *words;    // of grid.lists
  Spheres spheres;
  Real margin;
  Real pull_off;         // of the law, at a radius of 1
  StepCounts *counts;    // too_large becomes the first sphere that reaches past the grid
  int *n_springs;        // of each sphere, or null: those of spheres that are far are forgotten

  struct Item {
    Vec3 x;
    bool in_group, too_large;
  };
  using Key = std::uint64_t;    // 0: far; else what keep() needs

  LSDCD_FN Item read(std::size_t i) const
  {
    const bool in_group = !spheres.mask || (spheres.mask[i] & spheres.group_bit);
    return {spheres.x[i], in_group,
            in_group && !(reach_of(spheres.radius[i], pull_off) <= grid.reach)};
  }

  LSDCD_FN Key look(std::size_t i, const Item &item) const
  {
    if (!item.in_group) return 0;
    if (margin > 0) return i + 1;
    const BrickPlace at = brick_place_of(grid, item.x);
    const std::uint32_t brick = brick_in(word_at(words, at), at);
    return brick == kNoBrick ? 0 : Key(brick) * kBrickCells + at.cell + 1;
  }

  LSDCD_FN bool keep(Key key) const
  {
    if (margin > 0) return near_within(grid, words, spheres.x[key - 1], margin);
    return occupied_cell(grid.lists, static_cast<std::uint32_t>((key - 1) / kBrickCells),
                         static_cast<std::int32_t>((key - 1) % kBrickCells)) != kNoCell;
  }

  LSDCD_FN void note(std::size_t i, const Item &item, bool near) const
  {
    if (item.too_large) raise_to(&counts->too_large, kNoSphere - i);
    if (n_springs && !near) n_springs[i] = 0;
  }
};

}    // namespace lsdcd
