// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The input that a host gives to each step of a wall, in addition to its spheres.
#pragma once

#include "engine/engine.h"
#include "motion/step_clock.h"

#include <vector>

namespace lsdcd {

// The input of a step.
struct StepInput {
  Step step;
  bool look = false;           // spheres, radii or types may differ from those of the last step
  bool new_spheres = false;    // spheres may have come: the timestep and their overlaps are checked
  bool box_changes = false;    // the box may have changed since the last step
  SphereDrift drift;
  When when = When::in_turn;    // when the step does its work
  bool virial = false;          // add_virial() will be called
  // The values of spec().inputs in this step, the same on all processes. Those that inputs_read() does not name may
  // be any number.
  std::vector<Real> inputs;
  // Acceleration of spheres by the host: three numbers (force/mass) that may change until the next step. Null: none.
  const Real *gravity = nullptr;
};

}    // namespace lsdcd
