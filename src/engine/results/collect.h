// From the results of single spheres to forces, springs, outputs and totals.
#pragma once

#include "engine/wall_engine.h"
#include "engine/force/wall_force.h"

#include <vector>

namespace lsdcd {

// Results of the spheres near the wall, in ascending sphere order.
struct StepResults {
  std::vector<int> near;    // sphere of each result
  const SphereResult *result = nullptr;
  const Real *heat = nullptr;    // power into each; null where the law has none
};

// Adds the results to the spheres' force and torque arrays, and to their heat flow.
void add_forces(const StepResults &results, const Spheres &spheres);

// Sums in blocks of fixed size, then over the blocks in order: the same bits
// whatever the number of threads.
WallTotals sum_totals(const StepResults &results, const Spheres &spheres);

// Fills the columns of `contacts` for the spheres that touch; `heat` stays empty where
// the law has none.
void fill_sphere_output(const StepResults &results, const Spheres &spheres,
                        std::vector<int> &touching, std::vector<SphereOutput> &output,
                        std::vector<Real> &heat);

}    // namespace lsdcd
