// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall whose surface moves while its mesh stays: conveyors, rotating rolls.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct SurfaceMotion {
  Vec3 velocity = {0, 0, 0};    // length/time
  Vec3 angular = {0, 0, 0};     // 1/time, right-handed, about an axis through centre
  Vec3 centre = {0, 0, 0};      // length

  bool moves() const { return norm_sq(velocity) > 0 || norm_sq(angular) > 0; }

  // Returns the velocity of the surface at point p, a time `back` ago, in the plane with the unit normal n. The part along n is left out:
  // the wall stays where it is.
  LSDCD_FN Vec3 along(const Vec3 &p, const Vec3 &n, Real back) const
  {
    const Vec3 turning = cross(angular, p - centre);
    const Vec3 u = velocity + turning - back * cross(angular, turning);
    return u - dot(u, n) * n;
  }
};

// Turns a vector perpendicular to the unit normal n about n by a small angle, whose tangent is a series.
LSDCD_FN Vec3 turn_about(const Vec3 &n, Real angle, const Vec3 &h)
{
  if (angle == 0) return h;
  const Real tangent = angle * (1 + angle * angle / 3);
  return (1 / sqrt(1 + tangent * tangent)) * (h + tangent * cross(n, h));
}

}    // namespace lsdcd
