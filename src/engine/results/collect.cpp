#include "engine/results/collect.h"

#include "parallel/threads.h"
#include "engine/results/totals.h"

#include <algorithm>

namespace lsdcd {

void add_forces(const StepResults &results, const Spheres &spheres)
{
  const int n = static_cast<int>(results.near.size());
#pragma omp parallel for schedule(static) num_threads(threads()) if (n > 4096)
  for (int k = 0; k < n; k++) {
    const SphereResult &r = results.result[k];
    if (r.n_contacts == 0) continue;
    const int i = results.near[k];
    spheres.force.add(i, r.force);
    spheres.torque.add(i, r.torque);
    if (results.heat) spheres.heat_flow[i] += results.heat[k];
  }
}

WallTotals sum_totals(const StepResults &results, const Spheres &spheres)
{
  const int n = static_cast<int>(results.near.size());
  const int n_blocks = (n + kTotalsBlock - 1) / kTotalsBlock;
  std::vector<WallTotals> block(n_blocks);
#pragma omp parallel for schedule(static) num_threads(threads()) if (n_blocks > 16)
  for (int b = 0; b < n_blocks; b++) {
    WallTotals t;
    for (int k = b * kTotalsBlock; k < std::min(n, (b + 1) * kTotalsBlock); k++) {
      const SphereResult &r = results.result[k];
      const int i = results.near[k];
      if (r.uncertain > 0) add_uncertain(t, r.uncertain / spheres.radius[i]);
      if (r.n_contacts > 0) add_result(t, r, cross(spheres.x[i], r.force) + r.torque, i);
    }
    block[b] = t;
  }
  WallTotals sum;
  for (const WallTotals &t : block) add_block(sum, t);
  return sum;
}

void fill_sphere_output(const StepResults &results, const Spheres &spheres,
                        std::vector<int> &touching, std::vector<SphereOutput> &output,
                        std::vector<Real> &heat)
{
  touching.clear();
  output.clear();
  for (std::size_t k = 0; k < results.near.size(); k++) {
    const SphereResult &r = results.result[k];
    if (r.n_contacts == 0) continue;
    const int i = results.near[k];
    touching.push_back(i);
    output.push_back(output_of(r, spheres.x[i], spheres.radius[i]));
    if (results.heat) heat.push_back(results.heat[k]);
  }
}

}    // namespace lsdcd
