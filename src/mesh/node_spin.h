// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The angular velocity of a face whose nodes move, and of a node: the mean of its faces, weighted by area.
#pragma once

#include "mesh/moving_records.h"

namespace lsdcd {

struct FaceSpin {
  Vec3 spin;    // 1/time
  Real size;    // twice the area
};

// The spin of a face is that of its plane, n x dn/dt, and about its normal half the curl of the velocities. With
// the edges e, f from one corner, the velocities d, g of their ends relative to it, and N = e x f,
//
//   dN/dt = d x f + e x g,   n . curl = n . ((f x n) x d + (n x e) x g)/|N|.
//
// For a rigid motion that is the angular velocity. The edges are those of `back` ago (time), when the velocities are of;
// a turn by an angle a in a step has the spin to a^2/12.
LSDCD_FN FaceSpin spin_of_face(const int *face, const Vec3 *at, const Vec3 *velocity, Real back)
{
  const Vec3 &a = at[face[0]], &va = velocity[face[0]];
  const Vec3 d = velocity[face[1]] - va, g = velocity[face[2]] - va, e = at[face[1]] - a - back * d,
             f = at[face[2]] - a - back * g;
  const Vec3 area = cross(e, f);
  const Real size = norm(area);
  const Vec3 n = (1 / size) * area, changes = (1 / size) * (cross(d, f) + cross(e, g));
  const Real curl = dot(n, cross(cross(f, n), d) + cross(cross(n, e), g)) / size;
  return {cross(n, changes) + (Real(0.5) * curl) * n, size};
}

}    // namespace lsdcd
