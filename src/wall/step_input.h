// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a host gives to each step of a wall, beside its spheres.
#pragma once

#include "engine/engine.h"
#include "motion/step_clock.h"

#include <vector>

namespace lsdcd {

// The input of a step.
struct StepInput {
  Step step;
  bool look = false;    // spheres may be others, or have other radii or types, since the last step
  bool new_spheres = false;    // spheres may have come: the timestep and their overlaps are checked
  bool box_changes = false;    // the box may have changed since the last step
  SphereDrift drift;
  When when = When::in_turn;    // its work is done
  bool virial = false;          // add_virial() will be called
  // The values of spec().inputs in this step, the same on all processes; of those that inputs_read() leaves out
  // any number.
  std::vector<Real> inputs;
  // Acceleration of spheres by the host, three numbers (force/mass) that may change until the next step; null: none.
  const Real *gravity = nullptr;
};

}    // namespace lsdcd
