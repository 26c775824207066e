// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads on the meshes of a wall, averaged over so many steps, as a solver of another field samples them.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "motion/step_clock.h"
#include "wall/spec/wall_spec.h"
#include "wall/sums/coat_load.h"
#include "wall/sums/step_totals.h"

#include <vector>

namespace lsdcd {

// The mean load of one mesh.
struct MeanLoad {
  Vec3 force = {0, 0, 0};     // on the mesh
  Vec3 torque = {0, 0, 0};    // on the mesh, about the point of MeshSpec::torque_about in each step
  Vec3 torque_at_origin = {0, 0, 0};    // about the origin of the box

  void add(const MeanLoad &more, Real times);
};

// What a saved state has of one mesh: sums over time, of all processes, since the last interval ended.
struct MeanLoadState {
  Real time = 0;    // of the sums
  MeanLoad sum, mean;
};

// Intervals end in steps whose number divides by WallSpec::average_every. A mean is over the steps of its interval that were
// simulated, weighted by their time; a step that sets a run up has none.
class MeanLoads {
 public:
  // Both arguments must outlive this object.
  MeanLoads(Host &host, const WallSpec &wall) :
      host_(host), wall_(wall), sums_(wall.meshes.size()), means_(wall.meshes.size())
  {
  }

  // Adds a step, with what StepTotals::reduce() takes. Local.
  void add(const Step &step, StepResults *results, const std::vector<Pose> &poses,
           const std::vector<NodeLoad> &nodes, const std::vector<CoatLoad> *coats);

  // Returns the mean of the last interval that has ended; 0 before. Collective.
  const MeanLoad &mesh(int k);
  // Returns the sum of the means of all meshes. Torques are about the origin of the box if the meshes have theirs about different points.
  // Collective.
  MeanLoad of_all();

  std::vector<MeanLoadState> save();    // collective
  void restore(int mesh, const MeanLoadState &was);

 private:
  void reduce();

  Host &host_;
  const WallSpec &wall_;
  Real time_ = 0;                 // of the sums
  std::vector<MeanLoad> sums_;    // over time, of this process
  std::vector<MeanLoad> means_;
  bool reduced_ = true;    // means are of all processes, and not of this one
};

}    // namespace lsdcd
