// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How fast a sphere strikes a wall that it does not touch alone.
//
// A sphere that falls into a fold strikes one side and then the other one, or both at once, but has its energy once. So the speed of
// an impact is that along the normal of what is left of the velocity when its parts along the normals that touch already, and along
// those of impacts before it, are taken away. With each part goes its own energy, m (v.n)^2/2, so that all have m v^2/2 at most.
// Overlaps are seen alike: the corner rule hides a contact behind those that push the sphere out of its overlap, so that it begins
// where it overlaps by more than that.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct Strike {
  Vec3 normal;     // unit, wall -> centre
  Real speed;      // of the centre towards the wall
  Real overlap;    // length
};

// What contacts have taken of a sphere's velocity, and by how far they push it out.
class TakenAway {
 public:
  LSDCD_FN Real speed_left(const Strike &s) const { return s.speed - dot(velocity_, s.normal); }
  LSDCD_FN Real overlap_left(const Strike &s) const
  {
    return s.overlap - fmax(Real(0), dot(way_, s.normal));
  }
  // Takes the parts along the normal, if any are left there.
  LSDCD_FN void take(const Strike &s)
  {
    const Real speed = speed_left(s), overlap = overlap_left(s);
    if (speed > 0) velocity_ += speed * s.normal;
    if (overlap > 0) way_ += overlap * s.normal;
  }

 private:
  Vec3 velocity_ = {0, 0, 0}, way_ = {0, 0, 0};
};

}    // namespace lsdcd
