// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The broad phase of one mesh: which spheres are candidates, because they could touch it after moving by at most a margin. The first
// test is made for all spheres, the second for those in a brick of the grid, and the third for those that pass the second, by cells.
// Selection runs the tests.
#pragma once

#include "backend/atomic.h"
#include "engine/grains.h"
#include "engine/lists/feature_list.h"
#include "engine/results/step_counts.h"
#include "grid/lookup/brick_filter.h"
#include "grid/lookup/grid_on.h"
#include "grid/lookup/occupied_within.h"
#include "law/reach.h"
#include "motion/pose.h"

namespace lsdcd {

template <class B>
struct EngineMesh {
  GridOn<B> grid;
  Pose pose, chosen;    // chosen: the pose at the last candidate search
};

// A grid with its pose, for kernels that make lists.
struct PosedGrid {
  GridView grid;
  Pose pose;
};

// Returns the query for a sphere at x. Springs do not matter to the broad phase.
LSDCD_FN QuerySphere query_sphere_at(const Pose &pose, const Vec3 &x, Real radius,
                                     const LawReach &reach)
{
  return {pose.to_mesh(x), radius, cutoff_of(radius, reach), nullptr, 0};
}

// Prefetches, on a CPU, what a search of a large wall reads first for a sphere at x, whose turn comes soon.
LSDCD_FN void prefetch_search([[maybe_unused]] const GridView &grid,
                              [[maybe_unused]] const Pose &pose, [[maybe_unused]] const Vec3 &x)
{
#if !LSDCD_ON_GPU()
  if (grid.is_large) prefetch_entries(grid, pose.to_mesh(x));
#endif
}

struct CandidateSpheres {
  StridedView<const Real> x;
  const Real *radius;
  LawReach reach;
  const int *index;    // the sphere of candidate k
  std::size_t n;       // number of candidates; 0: nothing is prefetched

  LSDCD_FN QuerySphere in_frame_of(const Pose &pose, std::size_t k) const
  {
    const int i = index[k];
    return query_sphere_at(pose, x[i], radius[i], reach);
  }
  LSDCD_FN void prefetch_ahead(const GridView &grid, const Pose &pose, std::size_t k) const
  {
    constexpr std::size_t kAhead = 4;
    if (k + kAhead < n) prefetch_search(grid, pose, x[index[k + kAhead]]);
  }
};

// kPast: do cells past the lists' own margin matter? kCloses: spheres that had contacts with the mesh in the last step are candidates
// wherever they are now, because the energy balance has to close these contacts.
template <bool kPast, bool kCloses>
struct CandidateTest {
  GridView grid;
  BrickTable table;
  BrickFilter<Real> filter;
  Spheres spheres;
  Pose pose;
  Real margin, past;     // lengths; past = margin - margin of the cells' lists, or 0
  LawReach reach;        // of the law
  bool by_features;      // test the features that cells list, too?
  StepCounts *counts;    // too_large becomes the first sphere that reaches past the grid
  int *n_springs;        // of each sphere, or null; becomes 0 for spheres that are not candidates
  SpringsView last;      // of the last step; read where kCloses
  std::uint32_t mesh;
  std::uint32_t fixed_margin = 0;    // of the filter

  struct Item {
    Real radius;
    int mask;
  };

  LSDCD_FN StridedView<const Real> centres() const { return spheres.x; }
  LSDCD_FN Item read(std::size_t i) const
  {
    return {spheres.radius[i], spheres.mask ? spheres.mask[i] : 0};
  }
  LSDCD_FN bool in_group(const Item &item) const
  {
    return !spheres.mask || (item.mask & spheres.group_bit);
  }

  // Returns whether a sphere could reach past the grid. check() then decides.
  LSDCD_FN bool may_be_large(const Item &item) const
  {
    return in_group(item) && (reach.acts() || !(item.radius <= grid.cutoff));
  }
  LSDCD_FN void check(std::size_t i, const Item &item) const
  {
    if (may_be_large(item) && !(cutoff_of(item.radius, reach) <= grid.cutoff))
      raise_to(&counts->too_large, kNoSphere - i);
  }

  // Tests the brick that holds x.
  LSDCD_FN bool coarse_test(const Item &item, const Vec3 &x) const
  {
    const BrickGuess guess = filter.guess(pose.to_mesh(x));
    // With a margin it is enough to read one brick if no other is within the margin.
    const bool sure = !guess.unsure & (!kPast || (guess.inside && fixed_margin > 0 &&
                                                  filter.is_clear(guess, fixed_margin)));
    bool may = !sure;
    if (guess.inside & sure) may = table.at(filter.index(grid, guess));
    return may & in_group(item);
  }
  // Tests the cells to which a sphere at x may move.
  LSDCD_FN bool is_near(const Vec3 &x) const
  {
    const Vec3 q = pose.to_mesh(x);
    if constexpr (kPast) return occupied_within(grid, table, q, past);
    return occupied_cell(grid, table, q) != kNoCell;
  }

  LSDCD_FN bool has_refine() const { return by_features; }
  // Tests the features of these cells.
  template <unsigned kSize>
  LSDCD_FN bool refine(const Warp<kSize> &warp, bool mine, std::size_t i) const
  {
    const QuerySphere s = query_sphere_at(pose, spheres.x[i], spheres.radius[i], reach);
    return can_touch(warp, mine, grid, s, margin);
  }
  // Prefetches, on a CPU, what refine() of a large wall reads first.
  LSDCD_FN void prefetch(const Vec3 &x) const { prefetch_search(grid, pose, x); }

  // Returns whether sphere i is a candidate even if it cannot touch the mesh.
  LSDCD_FN bool closes([[maybe_unused]] std::size_t i, [[maybe_unused]] const Item &item) const
  {
    if constexpr (kCloses) {
      if (!in_group(item)) return false;
      for (int k = 0; k < last.count[i]; k++)
        if (last.pool[last.first[i] + k].mesh == mesh) return true;
    }
    return false;
  }
  // Notes that sphere i is not a candidate.
  LSDCD_FN void note_out(std::size_t i) const
  {
    if (n_springs) n_springs[i] = 0;
  }
};

}    // namespace lsdcd
