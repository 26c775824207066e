// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The distance to a triangle by another method, the regions of its plane. It shares only vectors with the core.
#pragma once

#include "base/vec3.h"


namespace lsdcd {

// Squared distance from p to the triangle a b c, which must not be degenerate: the corner,
// the side or the inside in whose region p lies (Ericson 2005, section 5.1.5).
LSDCD_FN double region_distance_sq(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &p)
{
  const Vec3 u = b - a, v = c - a, from_a = p - a, from_b = p - b, from_c = p - c;
  const double ua = dot(u, from_a), va = dot(v, from_a), ub = dot(u, from_b), vb = dot(v, from_b),
               uc = dot(u, from_c), vc = dot(v, from_c);
  if (ua <= 0 && va <= 0) return norm_sq(from_a);
  if (ub >= 0 && vb <= ub) return norm_sq(from_b);
  if (vc >= 0 && uc <= vc) return norm_sq(from_c);
  // Areas of p's closest point with two of the corners, by the third's name.
  const double area_c = ua * vb - ub * va, area_b = uc * va - ua * vc, area_a = ub * vc - uc * vb;
  if (area_c <= 0 && ua >= 0 && ub <= 0) return norm_sq(from_a - (ua / (ua - ub)) * u);
  if (area_b <= 0 && va >= 0 && vc <= 0) return norm_sq(from_a - (va / (va - vc)) * v);
  if (area_a <= 0 && vb - ub >= 0 && uc - vc >= 0)
    return norm_sq(from_b - ((vb - ub) / ((vb - ub) + (uc - vc))) * (c - b));
  const Vec3 n = cross(u, v);
  const double height = dot(n, from_a);
  return height * height / norm_sq(n);
}

}    // namespace lsdcd
