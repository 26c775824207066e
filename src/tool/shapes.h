// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles of simple shapes. The normals of closed shapes point out. Equal corners have equal
// bits.
#pragma once

#include "base/vec3.h"

#include <array>
#include <vector>

namespace lsdcd {

using Triangles = std::vector<std::array<Vec3, 3>>;
using Line = std::vector<Vec3>;

struct RadiusHeight {
  Real r, z;
};
using Profile = std::vector<RadiusHeight>;

// A convex polygon; its corners are in counter-clockwise order, seen from outside.
Triangles fan(const Line &corners);

// Between two lines, from the first corners of both to the last; they may have different numbers of
// corners. Along `left`, then over to `right`, is counter-clockwise seen from behind.
Triangles between(const Line &left, const Line &right);

// The surface of a profile (r, z) that turns about the z axis in `segments` steps. An upward profile faces out.
Triangles turned(const Profile &profile, int segments);

// The arc of radius `round` that replaces corner `at` between its neighbours. It uses at most half of each
// edge; throws InputError if that is not enough.
Profile rounded_corner(const RadiusHeight &before, const RadiusHeight &at,
                       const RadiusHeight &after, Real round, int steps);

// Rectangle over x and y at z = 0, facing up; box from lo to hi.
Triangles plane_shape(Real width, Real depth);
Triangles box_shape(const Vec3 &size);

struct DrumShape {
  Real radius, length;
  int lifters;
  Real height, width;    // of a lifter
  bool closed;           // at its ends
  int segments;
};
// About the y axis, from y = 0 on.
Triangles drum_shape(const DrumShape &drum);

struct ScrewShape {
  Real radius, shaft, pitch, thickness, stub;    // stub: of shaft before and after the blade
  int turns, segments;
};
// A shaft along the y axis from y = 0 on, with a right-handed blade; one closed surface.
Triangles screw_shape(const ScrewShape &screw);

// Splits edges in two until none is longer than `edge`. Neighbours stay neighbours.
Triangles refined(Triangles coarse, Real edge);

}    // namespace lsdcd
