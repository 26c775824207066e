// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How a rigid body is held and driven.
#pragma once

#include "base/vec3.h"

#include <cmath>

namespace lsdcd {

// hinge: it turns about an axis. slider: it moves along one and does not turn. planar: its centre stays in a plane, and
// it turns about the normal. ball: it turns about a point.
enum class JointKind { free, hinge, slider, planar, ball };
constexpr const char *kJointNames[] = {"free", "hinge", "slider", "planar", "ball"};

struct Joint {
  JointKind kind = JointKind::free;
  Vec3 point = {0, 0, 0};    // of the box, length; of hinge and ball
  Vec3 axis = {0, 0, 1};     // of the box, a unit vector; of hinge and slider; the normal of planar

  // Does a point of the body stay where it is?
  bool has_point() const { return kind == JointKind::hinge || kind == JointKind::ball; }
  // Is its motion one number: a right-handed angle (hinge) or a length (slider), 0 where the body began?
  bool has_coordinate() const { return kind == JointKind::hinge || kind == JointKind::slider; }
  bool has_axis() const { return has_coordinate() || kind == JointKind::planar; }
  // What its kind does not have may differ: it stays from a joint of before.
  bool operator==(const Joint &other) const
  {
    return kind == other.kind && (!has_point() || point == other.point) &&
           (!has_axis() || axis == other.axis);
  }

  // Does it leave places along this unit vector as they are, and turn about nothing but it?
  bool keeps(const Vec3 &direction) const
  {
    constexpr Real kRounding = 1e-12;    // of unit vectors
    if (kind == JointKind::slider) return fabs(dot(axis, direction)) <= kRounding;
    return (kind == JointKind::hinge || kind == JointKind::planar) &&
           norm(cross(axis, direction)) <= kRounding;
  }
};

// The spring, damper, stops and motor of such a coordinate: forces for a slider, torques for a hinge.
struct JointDrive {
  Real stiffness = 0;                    // force/length or torque
  Real damping = 0;                      // force/velocity or torque time
  Real rest = 0;                         // coordinate where the spring has no force
  Real lo = -HUGE_VAL, hi = HUGE_VAL;    // of the coordinate; stops without rebound
  Real motor = 0;                        // force or torque
};

}    // namespace lsdcd
