// A wall whose surface moves while its mesh stays: conveyors, rotating rolls.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct SurfaceMotion {
  Vec3 velocity = {0, 0, 0};    // length/time
  Vec3 angular = {0, 0, 0};     // 1/time, right-handed, about an axis through centre
  Vec3 centre = {0, 0, 0};      // length

  bool moves() const { return norm_sq(velocity) > 0 || norm_sq(angular) > 0; }

  // Velocity of the surface at point p, in the plane with unit normal n. What would
  // push along n is left out: the wall stays where it is.
  LSDCD_FN Vec3 along(const Vec3 &p, const Vec3 &n) const
  {
    const Vec3 u = velocity + cross(angular, p - centre);
    return u - dot(u, n) * n;
  }
};

}    // namespace lsdcd
