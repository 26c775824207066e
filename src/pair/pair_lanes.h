// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of one law side by side: there is an array for every number of a pair, and a lane is the place of a pair in all
// of them.
#pragma once

#include "base/vec3.h"

#include <cstdint>

namespace lsdcd {

constexpr int kLanes = 32, kLaneChoices = 13;
constexpr int kMoreLanes =
    7;    // so many lanes after the last pair are computed, too, so that all vectors are full
constexpr int kLaneNumbers =
    10;    // the shear displacement, and what the laws with most numbers have in addition

using Lane = Real[kLanes];

struct alignas(64) PairLanes {
  // Grains: see GrainPair.
  Lane offset[3], velocity[3], omega_i[3], omega_j[3];
  Lane radius_i, radius_j, mass_i, mass_j, mass, temperature_difference;
  // ContactMemory before and after: shear displacement, then `extra`. It may also be elsewhere, with space for kMoreLanes
  // more.
  Lane memory[kLaneNumbers];
  const Real *before[kLaneNumbers];
  Real *after[kLaneNumbers];
  // Results: see PairForce.
  Lane force[3], torque_i[3], torque_j[3], heat, energy;
  std::int64_t choice[kLaneChoices][kLanes];
};

LSDCD_FN Vec3 lane_vec(const Lane (&a)[3], int k)
{
  return {a[0][k], a[1][k], a[2][k]};
}
LSDCD_FN void set_lane(Lane (&a)[3], int k, const Vec3 &v)
{
  a[0][k] = v.x;
  a[1][k] = v.y;
  a[2][k] = v.z;
}

}    // namespace lsdcd
