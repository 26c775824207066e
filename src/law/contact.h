// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments and results of a contact law.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// One sphere-wall contact in one step.
struct Contact {
  Vec3 normal;       // unit, wall -> centre
  Real overlap;      // length, > 0 where they touch
  Real radius;       // of the sphere; its effective radius against a wall
  Real mass;         // of the sphere, or of the rigid body it belongs to
  Real v_normal;     // length/time, > 0 when it moves away from the wall
  Vec3 v_tangent;    // length/time, of the sphere's surface at the contact
  Vec3 omega;        // 1/time, of the sphere; set only where the law has kContactTorque
  Real temperature_difference;    // wall less sphere; set only where it has kHeat
  Real dt;                        // time
  bool update;                    // false: springs act but do not move (setup)
};

struct ContactForce {
  Real normal;        // force along the normal, < 0 where it pulls
  Vec3 tangential;    // force on the sphere at the contact
  Real energy;        // elastic energy held
};

// Memory of a contact from step to step: a tangential spring and, with some laws, further
// numbers: first vectors in the tangent plane, then scalars.
template <int kExtra>
struct ContactMemory {
  static constexpr int kSize = kExtra;
  Vec3 shear;
  Real extra[kExtra];

  LSDCD_FN Vec3 vec(int at) const { return {extra[at], extra[at + 1], extra[at + 2]}; }
  LSDCD_FN void put(int at, const Vec3 &a)
  {
    for (int k = 0; k < 3; k++) extra[at + k] = a[k];
  }
};
template <>
struct ContactMemory<0> {
  static constexpr int kSize = 0;
  Vec3 shear;
};

}    // namespace lsdcd
