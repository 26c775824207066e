// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The load of a feature of a mesh over time: forces on it, and the volume worn off. A row, see feature_row.h.
#pragma once

#include "engine/results/step_results.h"

namespace lsdcd {

// Integrals over the time of an average, except `worn`, which is since the beginning.
struct Load {
  static constexpr int kSums = 7, kMost = 0;
  Real normal = 0;           // force time; of the normal forces, < 0 where they pull
  Real shear = 0;            // force time; of the sizes of the forces along the wall
  Real contacts = 0;         // time; of the number of contacts
  Real worn = 0;             // length^3
  Vec3 force = {0, 0, 0};    // force time; on the wall, in the frame of the mesh
};

// Returns what a contact adds to its feature in a step.
struct LoadOf {
  Real dt;          // time; duration of the step
  Real per_work;    // volume worn off per work; 1: Load::worn is the work of wear

  LSDCD_FN Load operator()(const StepContact &contact) const
  {
    Load load;
    load.normal = contact.normal * dt;
    load.shear = contact.shear * dt;
    load.contacts = dt;
    load.worn = per_work * contact.wear_power * dt;
    load.force = dt * contact.force;
    return load;
  }
};

}    // namespace lsdcd
