// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The box of a simulation: its periodic axes, and where the centres of spheres can be.
#pragma once

#include "base/vec3.h"

#include <algorithm>

namespace lsdcd {

struct Box {
  Vec3 lo, hi;    // length
};

// Calls f with each corner of a box.
template <class F>
void for_corners(const Box &box, const F &f)
{
  for (int i = 0; i < 8; i++)
    f(Vec3{i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 4 ? box.hi.z : box.lo.z});
}

// Makes the box larger where the point lies outside of it.
inline void extend(Box &box, const Vec3 &x)
{
  for (int k = 0; k < 3; k++) {
    box.lo[k] = std::min(box.lo[k], x[k]);
    box.hi[k] = std::max(box.hi[k], x[k]);
  }
}

inline Box box_around(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  Box box = {a, a};
  extend(box, b);
  extend(box, c);
  return box;
}

// Do two boxes have a common point?
inline bool overlap(const Box &a, const Box &b)
{
  for (int k = 0; k < 3; k++)
    if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
  return true;
}

constexpr Box kNoLimit = {{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};

struct PeriodicBox {
  Vec3 corner = {0, 0, 0};                             // length
  Vec3 edge[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};    // length; from the corner, right-handed
  bool periodic[3] = {false, false, false};            // along each edge
  // Faces that follow the spheres (shrink-wrapped): along each edge the lower and the upper one.
  bool face_follows[3][2] = {{false, false}, {false, false}, {false, false}};
  Real margin = 0;      // length; how far past a face a sphere may go before it is wrapped
  int dimension = 3;    // 2: spheres stay in the plane z = 0

  // Returns a point in units of the edges: 0 to 1 inside the box.
  Vec3 fraction(const Vec3 &x) const;
  // Distance between the two faces that edge k joins. Length.
  Real width(int k) const;

  // The box around all positions where spheres can be: the box, and `past` (length) beyond its
  // faces.
  Box bounds(const Vec3 &past) const;
  bool any_periodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  bool follows(int k) const { return face_follows[k][0] || face_follows[k][1]; }
  bool any_follows() const { return follows(0) || follows(1) || follows(2); }
};

// How far positions are past periodic faces, also on a device.
struct PeriodicFaces {
  Vec3 corner;
  Vec3 gradient[3];    // of the fractions
  Real width[3];       // length
  bool periodic[3];

  // Length; 0 inside.
  LSDCD_FN Real past(const Vec3 &x) const
  {
    const Vec3 d = x - corner;
    Real out = 0;
    for (int k = 0; k < 3; k++) {
      if (!periodic[k]) continue;
      const Real at = dot(gradient[k], d), below = -at * width[k], above = (at - 1) * width[k];
      if (below > out) out = below;
      if (above > out) out = above;
    }
    return out;
  }
};
PeriodicFaces periodic_faces(const PeriodicBox &box);

// Returns the bounds of a box in units of the edges of the periodic one.
Box in_fractions(const Box &box, const PeriodicBox &periodic);

}    // namespace lsdcd
