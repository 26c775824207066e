// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Under which solid angle a triangle is seen from a point (Van Oosterom and Strackee 1983).
#pragma once

#include "geometry/orientation.h"
#include "geometry/triangles_meet.h"

#include <cmath>
#include <limits>

namespace lsdcd {

// Half the solid angle is the angle of this vector: > 0 where the triangle's normal points away. The vector is
// the shorter the nearer the point is to an edge, in lengths of that edge. Rounding turns it by 8 units of the
// last place over its length.
struct HalfSolidAngle {
  Real sine,
      cosine;    // both 0 at a corner; where the cosine is below kBeside, the sine's sign is exact

  Real length_sq() const { return sine * sine + cosine * cosine; }
  Real value() const { return std::atan2(sine, cosine); }
};

constexpr Real kBeside = 1e-4;

namespace solid_angle_detail {

// 0 where it has no length.
inline Vec3 direction(const Vec3 &to)
{
  const Real square = norm_sq(to);
  const Real length = square > Real(1e-280) && square < Real(1e280) ? std::sqrt(square)
                                                                    : std::hypot(to.x, to.y, to.z);
  return length > 0 ? (1 / length) * to : Vec3{0, 0, 0};
}

}    // namespace solid_angle_detail

inline HalfSolidAngle half_solid_angle(const Triangle &t, const Vec3 &q)
{
  using solid_angle_detail::direction;
  const Vec3 a = direction(t[0] - q), b = direction(t[1] - q), c = direction(t[2] - q);
  const Vec3 none = {0, 0, 0};
  if (a == none || b == none || c == none) return {0, 0};
  HalfSolidAngle half = {dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a)};
  // Next to a triangle the side of its plane decides, and rounded signs of small volumes may be wrong.
  if (std::fabs(half.sine) < Real(1e-14) && half.cosine < kBeside) {
    const Real least = std::numeric_limits<Real>::min();
    half.sine = std::fmax(std::fabs(half.sine), least) * orientation(t[0], t[1], t[2], q);
  }
  return half;
}

}    // namespace lsdcd
