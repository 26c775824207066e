#include "engine/collect.h"

#include "base/threads.h"

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
    for (int c = 0; c < 3; c++) {
      spheres.force[3 * i + c] += r.force[c];
      spheres.torque[3 * i + c] += r.torque[c];
    }
    if (results.heat) spheres.heat_flow[i] += results.heat[k];
  }
}

WallTotals sum_totals(const StepResults &results, const Spheres &spheres)
{
  constexpr int kBlock = 256;
  const int n = static_cast<int>(results.near.size());
  const int n_blocks = (n + kBlock - 1) / kBlock;
  std::vector<WallTotals> block(n_blocks);
#pragma omp parallel for schedule(static) num_threads(threads()) if (n_blocks > 16)
  for (int b = 0; b < n_blocks; b++) {
    WallTotals t;
    for (int k = b * kBlock; k < std::min(n, (b + 1) * kBlock); k++) {
      const SphereResult &r = results.result[k];
      const int i = results.near[k];
      if (r.uncertain > 0) {
        t.uncertified++;
        t.largest_uncertain = std::max(t.largest_uncertain, r.uncertain / spheres.radius[i]);
      }
      if (r.n_contacts == 0) continue;
      const Vec3 x = {spheres.x[3 * i], spheres.x[3 * i + 1], spheres.x[3 * i + 2]};
      t.energy += r.energy;
      t.force -= r.force;
      t.torque -= cross(x, r.force) + r.torque;
      t.contacts += r.n_contacts;
      if (r.overlap_ratio > t.largest_overlap_ratio) {
        t.largest_overlap_ratio = r.overlap_ratio;
        t.largest_overlap_sphere = i;
      }
    }
    block[b] = t;
  }
  WallTotals sum;
  for (const WallTotals &t : block) {
    sum.energy += t.energy;
    sum.force += t.force;
    sum.torque += t.torque;
    sum.contacts += t.contacts;
    sum.uncertified += t.uncertified;
    sum.largest_uncertain = std::max(sum.largest_uncertain, t.largest_uncertain);
    if (t.largest_overlap_ratio > sum.largest_overlap_ratio) {
      sum.largest_overlap_ratio = t.largest_overlap_ratio;
      sum.largest_overlap_sphere = t.largest_overlap_sphere;
    }
  }
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
    // Contacts that exert no force still have a place: that of the sphere.
    const Vec3 point = r.weight > 0
                           ? (1 / r.weight) * r.weighted_point
                           : Vec3{spheres.x[3 * i], spheres.x[3 * i + 1], spheres.x[3 * i + 2]};
    touching.push_back(i);
    output.push_back({Real(r.n_contacts), r.force, point, spheres.radius[i]});
    if (results.heat) heat.push_back(results.heat[k]);
  }
}

}    // namespace lsdcd
