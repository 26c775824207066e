// Which spheres could be near the wall after a way of up to `margin`, as Backend::select asks:
// what is read of all of them, and what only those in a brick of the grid need.
#pragma once

#include "parallel/atomic.h"
#include "engine/force/law_job.h"
#include "grid/lookup/brick_filter.h"
#include "grid/lookup/near_within.h"

namespace lsdcd {

// kMoves: is the margin more than 0?
template <bool kMoves>
struct NearChoice {
  GridView grid;
  BrickTable table;
  BrickFilter<Real> filter;
  Spheres spheres;
  WallPose pose;
  Real margin;
  Real pull_off;         // of the law, at a radius of 1
  StepCounts *counts;    // too_large becomes the first sphere that reaches past the grid
  int *n_springs;        // of each sphere, or null: those of spheres that are far are forgotten
  std::uint32_t fixed_margin = 0;    // of the filter

  struct Item {
    Real radius;
    int mask;
  };

  LSDCD_FN StridedView<const Real> places() const { return spheres.x; }
  LSDCD_FN Item read(std::size_t i) const
  {
    return {spheres.radius[i], spheres.mask ? spheres.mask[i] : 0};
  }
  LSDCD_FN bool in_group(const Item &item) const
  {
    return !spheres.mask || (item.mask & spheres.group_bit);
  }

  // Could it reach past the grid? check() finds out.
  LSDCD_FN bool may_be_large(const Item &item) const
  {
    return in_group(item) && (pull_off > 0 || !(item.radius <= grid.cutoff));
  }
  LSDCD_FN void check(std::size_t i, const Item &item) const
  {
    if (may_be_large(item) && !(cutoff_of(item.radius, pull_off) <= grid.cutoff))
      raise_to(&counts->too_large, kNoSphere - i);
  }

  // `near_table`: the table, as a backend has it.
  template <class Table>
  LSDCD_FN bool may_keep(const Item &item, const Vec3 &x, const Table &near_table) const
  {
    const BrickGuess guess = filter.guess(pose.to_mesh(x));
    // With a margin it is enough to look at one brick where no other is within the margin.
    const bool sure = !guess.unsure & (!kMoves || (guess.inside && fixed_margin > 0 &&
                                                   filter.is_clear(guess, fixed_margin)));
    bool may = !sure;
    if (guess.inside & sure) may = near_table.at(filter.slot(grid, guess));
    return may & in_group(item);
  }
  template <class Table>
  LSDCD_FN bool keep(const Vec3 &x, const Table &near_table) const
  {
    return near_within(grid, near_table, pose.to_mesh(x), kMoves ? margin : 0);
  }

  LSDCD_FN bool notes() const { return n_springs; }
  LSDCD_FN void note(std::size_t i, bool near) const
  {
    if (!near) n_springs[i] = 0;
  }
};

}    // namespace lsdcd
