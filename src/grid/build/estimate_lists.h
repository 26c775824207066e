// What lists will hold, from a sample of their making: a grid that cannot fit is not built first.
#pragma once

#include "grid/plan/grid_plan.h"
#include "mesh/wall_features.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

// Entries of all lists, and pairs of a feature and an octant that are sorted for them: what is
// expected, and what there is at least but for one case in ten thousand. 0 where the lists are
// quickly made.
struct ListEstimate {
  double entries = 0, least_entries = 0, least_pairs = 0;
};

// `only`: as of bricks_that_meet().
ListEstimate estimate_lists(const WallFeatures &wall, const GridPlan &plan, bool primitives,
                            const std::vector<std::uint64_t> &only);

// Bytes of the lists of a grid: at least these, or these expected and a quarter more; infinite
// where they cannot be numbered.
struct LeastBytes {
  double least = 0, enough = 0;
};
LeastBytes estimate_bytes(const WallFeatures &wall, const GridPlan &plan,
                          const GridSettings &settings);

}    // namespace lsdcd
