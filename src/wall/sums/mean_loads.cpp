// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/mean_loads.h"

#include <algorithm>

namespace lsdcd {

namespace {

void sum_over_processes(Host &host, std::vector<MeanLoad> &loads)
{
  std::vector<Real> all;
  for (const MeanLoad &l : loads)
    for (const Vec3 *v : {&l.force, &l.torque, &l.torque_at_origin})
      all.insert(all.end(), {v->x, v->y, v->z});
  host.sum(all.data(), static_cast<int>(all.size()));
  const Real *at = all.data();
  for (MeanLoad &l : loads)
    for (Vec3 *v : {&l.force, &l.torque, &l.torque_at_origin}) {
      *v = {at[0], at[1], at[2]};
      at += 3;
    }
}

}    // namespace

void MeanLoad::add(const MeanLoad &more, Real times)
{
  force += times * more.force;
  torque += times * more.torque;
  torque_at_origin += times * more.torque_at_origin;
}

void MeanLoads::add(const Step &step, StepResults *results, const std::vector<Pose> &poses,
                    const std::vector<NodeLoad> &nodes, const std::vector<CoatLoad> *coats)
{
  const int n = static_cast<int>(sums_.size());
  for (int k = 0; k < n; k++) {
    const WallTotals t = totals_of_mesh(results, wall_, k);
    MeanLoad load;
    load.force = t.force;
    load.torque_at_origin = t.torque;
    // These are the same on all processes.
    if (!nodes.empty() && nodes[k].present)
      load.torque_at_origin = host_.is_first() ? nodes[k].moment : Vec3{0, 0, 0};
    if (coats && host_.is_first()) {
      load.force += (*coats)[k].force;
      load.torque_at_origin += (*coats)[k].torque_at_origin;
    }
    load.torque =
        load.torque_at_origin - cross(torque_point(wall_.meshes[k], poses[k]), load.force);
    sums_[k].add(load, step.dt);
  }
  time_ += step.dt;
  if (step.number % wall_.average_every != 0) return;
  for (int k = 0; k < n; k++) {
    means_[k] = MeanLoad();
    if (time_ > 0) means_[k].add(sums_[k], 1 / time_);
    sums_[k] = MeanLoad();
  }
  time_ = 0;
  reduced_ = false;
}

void MeanLoads::reduce()
{
  if (reduced_) return;
  sum_over_processes(host_, means_);
  reduced_ = true;
}

const MeanLoad &MeanLoads::mesh(int k)
{
  reduce();
  return means_[k];
}

MeanLoad MeanLoads::of_all()
{
  reduce();
  MeanLoad all;
  for (const MeanLoad &m : means_) all.add(m, 1);
  if (!torques_share_a_point(wall_)) all.torque = all.torque_at_origin;
  return all;
}

std::vector<MeanLoadState> MeanLoads::save()
{
  reduce();
  std::vector<MeanLoad> sums = sums_;
  sum_over_processes(host_, sums);
  std::vector<MeanLoadState> all;
  for (std::size_t k = 0; k < sums.size(); k++) all.push_back({time_, sums[k], means_[k]});
  return all;
}

// The sums of all processes go on with the first.
void MeanLoads::restore(int mesh, const MeanLoadState &was)
{
  time_ = was.time;
  sums_[mesh] = host_.is_first() ? was.sum : MeanLoad();
  means_[mesh] = was.mean;
}

}    // namespace lsdcd
