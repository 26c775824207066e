// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/lengths_to_try.h"

#include "grid/plan/grid_plan.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace lsdcd {

namespace {

Real rounded(Real length)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", length);
  return std::strtod(text, nullptr);
}

}    // namespace

Real rounded_up(Real length)
{
  const Real near = rounded(length);
  return near < length ? rounded(Real(1.001) * length) : near;
}

std::vector<Real> lengths_to_try(const WeldedMesh &mesh, const StepGridSettings &settings)
{
  const Real standard = plan_grid(mesh, settings).length;
  const double budget = double(settings.memory_budget > 0 ? settings.memory_budget : kListBudget);
  std::vector<Real> lengths;
  StepGridSettings on_cpu = settings;
  on_cpu.for_gpu = false;
  StepGridSettings nearest_one = on_cpu;
  nearest_one.nearest = 1;
  const Real of_nearest = default_length(mesh, nearest_one);
  StepGridSettings on_gpu = settings;
  on_gpu.for_gpu = true;
  // Defaults of both, so that a CPU and a GPU try the same cells.
  std::vector<Real> all = {0.5 * of_nearest,
                           of_nearest,
                           2 * of_nearest,
                           4 * of_nearest,
                           standard,
                           default_length(mesh, on_cpu),
                           default_length(mesh, on_gpu)};
  std::sort(all.begin(), all.end());
  for (Real length : all) {
    length = rounded(std::min(length, settings.cutoff));
    if (!lengths.empty() && length < 1.1 * lengths.back()) continue;
    StepGridSettings one = settings;
    one.length = length;
    if (plan_grid(mesh, one).least_bytes() <= budget) lengths.push_back(length);
  }
  // None fits: as build_grid does, take the first coarser one that may.
  if (lengths.empty()) {
    GridPlan plan = plan_grid(mesh, settings);
    while (plan.least_bytes() > budget && !is_coarsest(plan, mesh))
      plan = coarser(plan, mesh, settings);
    lengths.push_back(rounded_up(plan.length));
  }
  return lengths;
}

}    // namespace lsdcd
