// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of energy at a feature of a mesh since the beginning: what contacts dissipate, and how hard spheres hit. A row,
// see feature_row.h.
#pragma once

#include "engine/results/step_results.h"

namespace lsdcd {

struct PlaceEnergy {
  static constexpr int kSums = 3, kMost = 1;
  Real dissipated = 0;       // energy
  Real impacts = 0;          // number
  Real impact_energy = 0;    // energy; the sum of m v^2/2
  Real impact_speed = 0;     // length/time; the greatest v
};

// Returns what a record adds to its feature.
struct PlaceEnergyOf {
  LSDCD_FN PlaceEnergy operator()(const EnergyRecord &record) const
  {
    PlaceEnergy energy;
    energy.dissipated = record.dissipated;
    energy.impacts = record.impact > 0 ? 1 : 0;
    energy.impact_energy = record.impact;
    energy.impact_speed = record.speed;
    return energy;
  }
};

}    // namespace lsdcd
