// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What lists will hold, from a sample of their making: a grid that cannot fit is not built first.
#pragma once

#include "grid/plan/grid_plan.h"
#include "mesh/wall_features.h"

namespace lsdcd {

// Entries of all lists, and pairs of a feature and an octant that are sorted for them: what is
// expected, and what there is at least but for one case in ten thousand. 0 where the lists are
// quickly made.
struct ListEstimate {
  double entries = 0, least_entries = 0, least_pairs = 0;
  double work = 0;    // that is expected, as of BuildLimit
};

ListEstimate estimate_lists(const WallFeatures &wall, const GridPlan &plan, bool primitives);

// Of the lists of a grid: at least these bytes, or these expected and a quarter more, infinite where
// they cannot be numbered; and the work of making them, as of BuildLimit.
struct BuildEstimate {
  double least_bytes = 0, enough_bytes = 0, work = 0;
};
BuildEstimate estimate_build(const WallFeatures &wall, const GridPlan &plan,
                             const GridSettings &settings);

}    // namespace lsdcd
