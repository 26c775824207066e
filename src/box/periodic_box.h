// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The box of a simulation: its periodic axes, and where the centres of spheres can be.
#pragma once

#include "mesh/box.h"

namespace lsdcd {

struct PeriodicBox {
  Vec3 corner = {0, 0, 0};                             // length
  Vec3 edge[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};    // length; from the corner, right-handed
  bool periodic[3] = {false, false, false};            // along each edge
  // Faces that follow the spheres (shrink-wrapped): along each edge the lower and the upper one.
  bool face_follows[3][2] = {{false, false}, {false, false}, {false, false}};
  // Spheres can be anywhere along an edge: its faces are no limit, and nobody moves them.
  bool unlimited[3] = {false, false, false};
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
  void make_unlimited(int k)
  {
    periodic[k] = false;
    face_follows[k][0] = face_follows[k][1] = unlimited[k] = true;
  }
  // Returns a box without any limit: spheres go anywhere.
  static PeriodicBox anywhere()
  {
    PeriodicBox box;
    for (int k = 0; k < 3; k++) box.make_unlimited(k);
    return box;
  }
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
