// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments and results of a contact law.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// One sphere-wall contact in one step. T is the type that forces are computed in.
template <class T>
struct Contact {
  Vec3Of<T> normal;            // unit, wall -> centre
  T overlap;                   // length, > 0 where they touch
  T radius;                    // of the sphere; its effective radius against a wall
  T mass;                      // of the sphere, or of the rigid body it belongs to
  T v_normal;                  // length/time, > 0 when it moves away from the wall
  Vec3Of<T> v_tangent;         // length/time, of the sphere's surface at the contact
  Vec3Of<T> omega;             // 1/time, of the sphere; set only where the law has kContactTorque
  T temperature_difference;    // wall less sphere; set only where it has kHeat
  T dt;                        // time
  bool update;                 // false: springs act but do not move (setup)
};

template <class T>
struct ContactForce {
  T normal;                // force along the normal, < 0 where it pulls
  Vec3Of<T> tangential;    // force on the sphere at the contact
  T energy;                // elastic energy held
};

// Memory of a contact from step to step: a tangential spring and, with some laws, further
// numbers: first vectors in the tangent plane, then scalars.
template <class T, int kExtra>
struct ContactMemory {
  static constexpr int kSize = kExtra;
  Vec3Of<T> shear;
  T extra[kExtra];

  LSDCD_FN Vec3Of<T> vec(int at) const { return {extra[at], extra[at + 1], extra[at + 2]}; }
  LSDCD_FN void put(int at, const Vec3Of<T> &a)
  {
    for (int k = 0; k < 3; k++) extra[at + k] = a[k];
  }
};
template <class T>
struct ContactMemory<T, 0> {
  static constexpr int kSize = 0;
  Vec3Of<T> shear;
};

}    // namespace lsdcd
