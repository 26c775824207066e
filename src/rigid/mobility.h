// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How easily a point of a rigid body gives way to a push.
#pragma once

#include "rigid/symmetric_matrix.h"

namespace lsdcd {

// An impulse J n at a point of the body changes the velocity of that point along n by J n.K n. In the frame of the
// mesh, where these numbers stay as they are while the body moves as its joint allows; a body that comes to a stop or
// leaves it has others.
struct Mobility {
  Vec3 point = {0, 0, 0};    // the centre of mass, or a point that a joint holds
  SymmetricMatrix shifts;    // 1/mass: velocity of `point` by a force
  SymmetricMatrix turns;     // 1/(mass length^2): angular velocity by a torque

  // Velocity of `point` and angular velocity of a motion into the stop at which the body is; 0: it is at none.
  Vec3 into_stop = {0, 0, 0}, turn_into_stop = {0, 0, 0};

  // Does the stop bear this force, and torque about `point`?
  LSDCD_FN bool is_borne(const Vec3 &force, const Vec3 &torque) const
  {
    return dot(into_stop, force) + dot(turn_into_stop, torque) > 0;
  }

  bool any() const { return shifts.trace() > 0 || turns.trace() > 0; }

  // n.K n at the place x, for a unit vector n out of the body, against which the push goes; 1/mass. 0 where a stop bears it.
  LSDCD_FN Real along(const Vec3 &x, const Vec3 &n) const
  {
    const Vec3 arm = cross(x - point, n);
    if (is_borne(-n, -arm)) return 0;
    return dot(n, shifts * n) + dot(arm, turns * arm);
  }
};

inline Mobility operator*(Real s, const Mobility &m)
{
  return {m.point, s * m.shifts, s * m.turns, m.into_stop, m.turn_into_stop};
}

}    // namespace lsdcd
