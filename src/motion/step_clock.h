// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The time of a wall, counted by the host's steps.
#pragma once

#include "base/real.h"

#include <cstdint>

namespace lsdcd {

// In this type the product of 1e9 steps and a timestep has a relative error of 2^-64.
using Time = long double;

// A step of the host.
struct Step {
  enum Kind {
    setup,      // begins a run: no time has passed since the last step
    step,       // follows the last step
    snapshot    // read from a file: only its number tells its time
  };
  std::int64_t number = 0;
  Real dt = 0;    // time
  Kind kind = step;
  bool synchronous = false;    // velocities of spheres and nodes are of the time of their places

  // Returns how long before their places velocities are (time): half a step with velocity Verlet, as it asks for forces.
  Real velocities_behind() const { return kind == step && !synchronous ? dt / 2 : 0; }
};

// Time advances by one dt in each step, whatever number the host gives the step: it is base at
// base_step, and dt more for each step since.
struct StepClock {
  Time base = 0;
  std::int64_t base_step = 0, last_step = 0;
  Real dt = 0;

  Time now() const { return base + Time(last_step - base_step) * dt; }
  void advance(const Step &to);
};

}    // namespace lsdcd
