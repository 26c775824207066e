// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// On which side of a plane or a line a point lies, without rounding.
#pragma once

#include "base/vec3.h"
#include "geometry/expansion.h"

namespace lsdcd {

// Signs of determinants of differences of coordinates: first in Real with a bound of the error,
// then exactly where that does not decide.
//
// With u = 2^-53, a difference is right to a factor 1 + u, and so is each product and sum after
// it. In |a d| |b e - c f| a term goes through 3 differences, 2 products, the difference of the
// minor and 2 sums, of which Shewchuk (1997, section 4.3) counts (7 + 56 u) u of the permanent,
// itself rounded; in the plane (3 + 16 u) u. The bounds here are 8 u and 4 u. Products below
// 2^-1022 lose up to 2^-1075 each: six minors' products by differences below 2^340, and three
// more, 2^-730 in all. Where a number overflows, the permanent is infinite or not a number, and
// the exact sign is computed.
//
// Exact signs are of coordinates times a power of two that takes the largest to 2^330: of four
// points, products of three differences are then below 2^1000, and their last bits are at 2^-1056
// or above, within the range of Real, if no coordinate is below 2^-300. Smaller ones, less
// than 2^-630 (1e-190) of the largest, count as 0.

namespace orientation_detail {

constexpr int kTop = 330;
constexpr Real kTiny = 0x1p-300, kLost = 0x1p-700, kLargest = 0x1p340;

LSDCD_FN Real largest_of(const Vec3 &a)
{
  return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}
LSDCD_FN Real scaled(Real a, int by)
{
  const Real s = std::ldexp(a, by);
  return fabs(s) < kTiny ? 0 : s;
}
LSDCD_FN int exponent_of(Real a)
{
  int e = 0;
  std::frexp(a, &e);
  return e;
}
LSDCD_FN Vec3 scaled(const Vec3 &a, int by)
{
  return {scaled(a.x, by), scaled(a.y, by), scaled(a.z, by)};
}

// a b - c d
LSDCD_FN FixedExpansion<16> minor(const FixedExpansion<2> &a, const FixedExpansion<2> &b,
                                  const FixedExpansion<2> &c, const FixedExpansion<2> &d)
{
  return a.times(b).plus(c.times(d, -1));
}

inline LSDCD_NOINLINE int exact(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
  const int shift = kTop - exponent_of(fmax(fmax(largest_of(a), largest_of(b)),
                                            fmax(largest_of(c), largest_of(d))));
  a = scaled(a, shift), b = scaled(b, shift), c = scaled(c, shift), d = scaled(d, shift);
  const FixedExpansion<2> ax(a.x, d.x), ay(a.y, d.y), bx(b.x, d.x), by(b.y, d.y), cx(c.x, d.x),
      cy(c.y, d.y);
  const FixedExpansion<2> az(a.z, d.z), bz(b.z, d.z), cz(c.z, d.z);
  return minor(bx, cy, cx, by)
      .times(az)
      .plus(minor(cx, ay, ax, cy).times(bz))
      .plus(minor(ax, by, bx, ay).times(cz))
      .sign();
}

inline LSDCD_NOINLINE int exact_in_plane(Vec3 a, Vec3 b, Vec3 c, int u, int v)
{
  const int by = kTop - exponent_of(fmax(largest_of(a), fmax(largest_of(b), largest_of(c))));
  a = scaled(a, by), b = scaled(b, by), c = scaled(c, by);
  return minor(FixedExpansion<2>(a[u], c[u]), FixedExpansion<2>(b[v], c[v]),
               FixedExpansion<2>(a[v], c[v]), FixedExpansion<2>(b[u], c[u]))
      .sign();
}

}    // namespace orientation_detail

// Returns the sign of det(a - d, b - d, c - d): -1 where a, b, c turn to the left as seen from d, 1 to the right; 0 where
// rounded numbers do not decide.
LSDCD_FN int rounded_orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  using namespace orientation_detail;
  const Vec3 ad = a - d, bd = b - d, cd = c - d;
  const Real bc = bd.x * cd.y, cb = cd.x * bd.y, ca = cd.x * ad.y, ac = ad.x * cd.y,
             ab = ad.x * bd.y, ba = bd.x * ad.y;
  const Real det = ad.z * (bc - cb) + bd.z * (ca - ac) + cd.z * (ab - ba);
  const Real za = fabs(ad.z), zb = fabs(bd.z), zc = fabs(cd.z);
  const Real permanent =
      (fabs(bc) + fabs(cb)) * za + (fabs(ca) + fabs(ac)) * zb + (fabs(ab) + fabs(ba)) * zc;
  const Real bound = 4 * kRoundoff * permanent + kLost;
  if (fabs(det) > bound && za + zb + zc < kLargest) return det > 0 ? 1 : -1;
  return 0;
}

// Returns the sign that rounded_orientation() returns where it is sure, and the exact one elsewhere: 0 where all four
// points are in one plane.
LSDCD_FN int orientation(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
{
  const int rounded = rounded_orientation(a, b, c, d);
  return rounded != 0 ? rounded : orientation_detail::exact(a, b, c, d);
}

// Returns the exact orientation of the projections of three points along an axis, 0 to 2: 1 where a, b, c turn to the
// left.
LSDCD_FN int orientation_along(int axis, const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const Real left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
  const Real det = left - right;
  if (fabs(det) > 2 * kRoundoff * (fabs(left) + fabs(right)) + orientation_detail::kLost)
    return det > 0 ? 1 : -1;
  return orientation_detail::exact_in_plane(a, b, c, u, v);
}

}    // namespace lsdcd
