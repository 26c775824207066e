// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A servo moves a mesh along an axis, or turns it about one, so that it pushes the spheres with a
// given force or torque.
#pragma once

#include "base/vec3.h"
#include "motion/inputs.h"

#include <cmath>

namespace lsdcd {

// Numbers of a servo are a force, a length and a velocity or, if it turns the mesh, a torque, an angle and its velocity.
struct Servo {
  bool present = false;
  bool holds = false;    // no longer moves, and keeps its position
  bool turns = false;
  Vec3 axis = {0, 0, 1};                 // unit, of the box
  Vec3 point = {0, 0, 0};                // of the box; the axis passes through it, where it turns
  Real target = 0;                       // push on the spheres along (about) the axis
  int target_input = kNoInput;           // of the host, whose value target is
  Real max_gain = HUGE_VAL;              // velocity per push
  Real max_speed = 0;                    // velocity
  Real lo = -HUGE_VAL, hi = HUGE_VAL;    // of the position

  // The state, which is added up from step to step.
  Real position = 0, velocity = 0;

  // Returns whether both servos move a mesh along the same line, or turn it about the same line.
  bool has_line_of(const Servo &other) const
  {
    return present == other.present && turns == other.turns && axis == other.axis &&
           point == other.point;
  }

  // Returns the push, from the force and the torque about the origin that spheres exert on the mesh.
  Real push(const Vec3 &force, const Vec3 &torque) const
  {
    return 0 - dot(axis, turns ? torque - cross(point, force) : force);    // none: 0, not -0
  }

  // Moves the servo for a time dt, after a step with this push. A push below the target moves the servo forward, which makes the push grow.
  // Returns whether a limit has stopped it.
  bool advance(Real push, Real gain, Real dt);
};

// Returns a gain (velocity per push) with which the loop of a servo and its contacts is stable. In a step the push changes by -stiffness dt
// v and, by damping, by -damping v. With v(n+1) = gain (target - push(n)) the loop is stable for gain (stiffness dt + 2 damping) < 2. The
// gain is a quarter of that limit, which leaves room for the motion of the spheres (tests/unit/test_servo.cpp).
Real servo_gain(Real stiffness, Real damping, Real dt);

}    // namespace lsdcd
