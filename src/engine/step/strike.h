// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The speed at which a sphere strikes a wall while it also touches others.
// A sphere that falls into a fold strikes one side and then the other, or both at once, but has its energy only once. So the speed of
// an impact is that along the normal of the velocity that is left after two kinds of parts have been taken away: those along normals
// that touch already, and those of impacts before it. With each part goes its own energy, m (v.n)^2/2, so that all together have at
// most m v^2/2. Overlaps are treated in the same way: the corner rule hides a contact behind those that push the sphere out of its
// overlap, so that the contact begins when its overlap is larger than that.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct Strike {
  Vec3 normal;     // unit, wall -> centre
  Real speed;      // of the centre towards the wall
  Real overlap;    // length
};

// The parts of a sphere's velocity that contacts have taken, and how far they push the sphere out.
class TakenAway {
 public:
  LSDCD_FN Real speed_left(const Strike &s) const { return s.speed - dot(velocity_, s.normal); }
  LSDCD_FN Real overlap_left(const Strike &s) const
  {
    return s.overlap - fmax(Real(0), dot(way_, s.normal));
  }
  // Takes the part along the normal away, if any is left.
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
