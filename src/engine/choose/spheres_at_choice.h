// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres at a choice, as the search sees them.
#pragma once

#include "engine/lists/touch.h"
#include "law/submodels/normal.h"
#include "motion/pose.h"

namespace lsdcd {

// A sphere at x: at a choice none holds on to anything.
LSDCD_FN QuerySphere seen_at_choice(const Pose &pose, const Vec3 &x, Real radius, Real pull_off)
{
  return {pose.to_mesh(x), radius, cutoff_of(radius, pull_off), nullptr, 0};
}

// On a CPU: what a search of a large wall reads first for a sphere at x, whose turn comes soon.
LSDCD_FN void prefetch_search([[maybe_unused]] const GridView &grid,
                              [[maybe_unused]] const Pose &pose, [[maybe_unused]] const Vec3 &x)
{
#if !LSDCD_ON_GPU()
  if (grid.is_large) prefetch_candidates(grid, pose.to_mesh(x));
#endif
}

struct SpheresAtChoice {
  StridedView<const Real> x;
  const Real *radius;
  Real pull_off;
  const int *near;    // the sphere of each k
  std::size_t n;      // of these; 0: nothing is prefetched

  LSDCD_FN QuerySphere seen_from(const Pose &pose, std::size_t k) const
  {
    const int i = near[k];
    return seen_at_choice(pose, x[i], radius[i], pull_off);
  }
  LSDCD_FN void prefetch_ahead(const GridView &grid, const Pose &pose, std::size_t k) const
  {
    constexpr std::size_t kPlaces = 4;
    if (k + kPlaces < n) prefetch_search(grid, pose, x[near[k + kPlaces]]);
  }
};

}    // namespace lsdcd
