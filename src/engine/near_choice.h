// Which spheres could be near the wall after a way of up to `margin`, as Backend::select asks:
// what is read of all of them, and what only those in a brick of the grid need.
#pragma once

#include "base/atomic.h"
#include "engine/law_job.h"
#include "grid/near_within.h"

namespace lsdcd {

// kMoves: is the margin more than 0?
template <bool kMoves>
struct NearChoice {
  GridView grid;
  const BrickWord *words;    // of grid.lists
  Spheres spheres;
  Real margin;
  Real pull_off;         // of the law, at a radius of 1
  StepCounts *counts;    // too_large becomes the first sphere that reaches past the grid
  int *n_springs;        // of each sphere, or null: those of spheres that are far are forgotten

  struct Item {
    Real radius;
    bool in_group;
  };

  LSDCD_FN Rows<const Real> places() const { return spheres.x; }
  LSDCD_FN Item read(std::size_t i) const
  {
    return {spheres.radius[i], !spheres.mask || (spheres.mask[i] & spheres.group_bit)};
  }

  LSDCD_FN bool may_keep(std::size_t i, const Item &item, const Vec3 &x) const
  {
    if (!item.in_group) return false;
    if (!(reach_of(item.radius, pull_off) <= grid.reach))
      raise_to(&counts->too_large, kNoSphere - i);
    if (kMoves) return true;
    const BrickPlace at = brick_place_of(grid, x);
    return has_brick(word_at(words, at), at.place);
  }

  LSDCD_FN bool keep(const Vec3 &x) const
  {
    return near_within(grid, words, x, kMoves ? margin : 0);
  }

  LSDCD_FN void note(std::size_t i, bool near) const
  {
    if (n_springs && !near) n_springs[i] = 0;
  }
};

}    // namespace lsdcd
