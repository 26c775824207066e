// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The size of lists, estimated from a sample, so that a grid that cannot fit is not built.
#pragma once

#include "grid/plan/grid_plan.h"
#include "mesh/mesh_features.h"

namespace lsdcd {

// Entries of all lists, and pairs of a feature and an octant that are sorted for them: expected
// values, and lower bounds that hold in all but one case of ten thousand. 0 if the lists are quickly
// made.
struct ListEstimate {
  double entries = 0, least_entries = 0, least_pairs = 0;
  double work = 0;    // that is expected, as of BuildLimit
};

ListEstimate estimate_lists(const MeshFeatures &wall, const GridPlan &plan, bool primitives);

// For the lists of a grid: a lower bound of their bytes; the expected bytes plus a quarter, infinite
// if entries cannot be numbered; and the work of making them, in the units of BuildLimit.
struct BuildEstimate {
  double least_bytes = 0, enough_bytes = 0, work = 0;
};
BuildEstimate estimate_build(const MeshFeatures &wall, const GridPlan &plan,
                             const AnyGridSettings &settings);

}    // namespace lsdcd
