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

// Returns a convex polygon; its corners are in counter-clockwise order, viewed from outside.
Triangles fan(const Line &corners);

// Between two lines, from the first corners of both to the last; they may have different numbers of
// corners. Along `left`, then over to `right`, is counter-clockwise viewed from behind.
Triangles between(const Line &left, const Line &right);

// `edge` is the longest edge that is wanted, 0: any. Shapes are made of strips with triangles that are nearly equal;
// refined() then splits what is still too long.

// Edges across a strip of this part of the limit leave room for equal triangles: sqrt(3) / 2.
constexpr Real kAcross = 0.866;

// Throws InputError for more triangles than a mesh may have.
void check_triangles(Real n, Real edge);

// How lines beside each other are cut: into n equal pieces; `shifted`: every second one into n - 1, and half a piece at
// both ends.
struct Rows {
  int n;
  bool shifted;
};
// As few as leave the edges of a strip of this width, below `edge`, and length.
Rows rows_between(Real width, Real length, Real edge);
Line column(const Vec3 &a, const Vec3 &b, const Rows &rows, bool odd);
// As refined() cuts it.
Line cut(const Line &line, Real edge);
// As between(), but the next edge is the shorter one of two. Lines may meet in a point at either end.
void add_strip(Triangles &to, const Line &left, const Line &right);

// Returns the surface of a profile (r, z) that turns about the z axis in `segments` steps. An upward profile faces out.
Triangles turned(const Profile &profile, int segments, Real edge);

// Returns the arc of radius `round` that replaces corner `at` between its neighbours. It uses at most half of each edge;
// throws InputError if that is not enough.
Profile rounded_corner(const RadiusHeight &before, const RadiusHeight &at,
                       const RadiusHeight &after, Real round, int steps);

// Rectangle over x and y at z = 0, facing up; box from lo to hi.
Triangles plane_shape(Real width, Real depth, Real edge);
Triangles box_shape(const Vec3 &size, Real edge);

struct DrumShape {
  Real radius, length;
  int lifters;
  Real height, width;    // of a lifter
  bool closed;           // at its ends
  int segments;
  Real edge;
};
// About the y axis, from y = 0 on.
Triangles drum_shape(const DrumShape &drum);

struct ScrewShape {
  Real radius, shaft, pitch, thickness, stub;    // stub: of shaft before and after the blade
  int turns, segments;
  Real edge;
};
// Returns a shaft along the y axis from y = 0 on, with a right-handed blade; one closed surface.
Triangles screw_shape(const ScrewShape &screw);

// Splits edges in two until none is longer than `edge`. Neighbours stay neighbours.
Triangles refined(Triangles coarse, Real edge);

}    // namespace lsdcd
