// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contacts of a step on this process say to a host.
#pragma once

#include "engine/engine.h"
#include "motion/pose.h"

#include <functional>
#include <vector>

namespace lsdcd {

// A contact of a sphere with a mesh. Forces are those of a step, places those that it began with. Of a contact that the step has ended
// both are 0, and the point is where it was.
struct WallContact {
  int sphere, mesh;
  Vec3 force;      // on the sphere
  Vec3 point;      // of the mesh: the closest to the centre, or the deepest in a grain of shape
  Real overlap;    // length
  bool has_ended = false;
  const KeptLosses *losses = nullptr;    // until the next step; null: no energy is recorded
};

// See the functions of Wall with these names. `poses`: of its meshes in the step of the results.
void add_virial(const StepResults &results, const std::vector<Pose> &poses, Real *virial);
void for_contact_rows(const StepResults &results,
                      const std::function<void(int, const Real *)> &row);
void for_contacts(WallEngine &engine, const std::vector<Pose> &poses,
                  const std::function<void(const WallContact &)> &found);

}    // namespace lsdcd
