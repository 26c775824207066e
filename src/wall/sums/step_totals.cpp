// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/step_totals.h"

#include <algorithm>

namespace lsdcd {

namespace {

// Of a rigid mesh on what touches it. From 0, so that it is not -0 at rest.
Real power_of(const MeshTotals &m, const Pose &pose)
{
  return 0 - dot(m.force, pose.velocity) -
         dot(m.torque_at_origin - cross(pose.shift, m.force), pose.angular);
}

}    // namespace

WallTotals totals_of_mesh(StepResults *results, const WallSpec &wall, int k)
{
  if (!results) return {};
  return wall.meshes.size() > 1 ? results->mesh_totals(k) : results->totals();
}

void StepTotals::clear()
{
  std::fill(meshes_.begin(), meshes_.end(), MeshTotals());
  reduced_ = true;
}

void StepTotals::reduce(StepResults *results, const std::vector<Pose> &poses,
                        const std::vector<NodeLoad> &nodes, const std::vector<CoatLoad> *coats)
{
  if (reduced_) return;
  constexpr int kSums = 9;
  const int n = static_cast<int>(meshes_.size());
  std::vector<Real> sum, most;
  for (int k = 0; k < n; k++) {
    const WallTotals t = totals_of_mesh(results, settings_, k);
    sum.insert(sum.end(),
               {t.force.x, t.force.y, t.force.z, t.torque.x, t.torque.y, t.torque.z,
                static_cast<Real>(t.contacts), static_cast<Real>(t.uncertified), t.energy});
    most.push_back(t.largest_overlap_ratio);
  }
  for (const NodeLoad &of : nodes) sum.push_back(of.power);
  host_.sum_and_max(sum.data(), static_cast<int>(sum.size()), most.data(), n);
  for (int k = 0; k < n; k++) {
    const Real *const s = sum.data() + kSums * k;
    const Pose &pose = poses[k];
    MeshTotals &m = meshes_[k];
    m.force = {s[0], s[1], s[2]};
    m.torque_at_origin = {s[3], s[4], s[5]};
    if (!nodes.empty() && nodes[k].present) {
      m.couple = m.torque_at_origin - nodes[k].moment;
      m.torque_at_origin = nodes[k].moment;
    }
    m.contacts = s[6];
    m.overlap = most[k];
    m.uncertified = s[7];
    m.energy = s[8];
    if (coats) {
      const CoatLoad &coat = (*coats)[k];
      m.force += coat.force;
      m.torque_at_origin += coat.torque_at_origin;
      m.energy += coat.energy;
    }
    m.torque = m.torque_at_origin - cross(torque_point(settings_.meshes[k], pose), m.force);
    m.power = power_of(m, pose);
    if (!nodes.empty()) m.power += sum[kSums * n + k];
  }
  reduced_ = true;
}

void StepTotals::set_power(int mesh, const Pose &pose)
{
  meshes_[mesh].power = power_of(meshes_[mesh], pose);
}

MeshTotals StepTotals::of_all() const
{
  MeshTotals all = meshes_.front();
  for (std::size_t k = 1; k < meshes_.size(); k++) {
    const MeshTotals &m = meshes_[k];
    all.force += m.force;
    all.torque += m.torque;
    all.torque_at_origin += m.torque_at_origin;
    all.couple += m.couple;
    all.contacts += m.contacts;
    all.overlap = std::max(all.overlap, m.overlap);
    all.uncertified += m.uncertified;
    all.power += m.power;
    all.energy += m.energy;
  }
  if (!torques_share_a_point(settings_)) all.torque = all.torque_at_origin;
  return all;
}

}    // namespace lsdcd
