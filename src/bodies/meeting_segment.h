// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The segment in which two triangles cut each other.
#pragma once

#include "geometry/triangles_meet.h"

namespace lsdcd {

// The common segment of two triangles, rounded. `flat`: they lie in one plane, or one has no area, and
// there is no such segment.
struct MeetingSegment {
  Vec3 from, to;
  bool flat;
};

namespace meeting_segment_detail {

// The points at which the plane with this normal through x cuts a triangle: on the two sides at the corner that is
// alone. The signs of `sides` are exact, distances are rounded. If they contradict each other, the
// point stays on its side.
template <class Sides>
LSDCD_FN void cut(const Triangle &t, const Sides &sides, const Vec3 &normal, const Vec3 &x,
                  Vec3 (&ends)[2])
{
  const int i = sides.alone();
  const Real height = sides.of[i] == 0 ? 0 : fabs(dot(normal, t[i] - x));
  for (int k = 0; k < 2; k++) {
    const int j = (i + 1 + k) % 3;
    const Real other = sides.of[j] == 0 ? 0 : fabs(dot(normal, t[j] - x)), sum = height + other;
    const Real share = sum > 0 ? height / sum : Real(0.5);
    // A corner in the plane is the end itself.
    ends[k] = share >= 1 ? t[j] : t[i] + share * (t[j] - t[i]);
  }
}

LSDCD_FN Vec3 unit_normal(const Triangle &t)
{
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const Real length = norm(n);
  return length > 0 ? (1 / length) * n : Vec3{0, 0, 0};
}

}    // namespace meeting_segment_detail

// For two triangles that meet. `Sign`: rounded signs are enough if they have decided that.
template <class Sign = triangles_meet_detail::ExactSign>
LSDCD_FN MeetingSegment meeting_segment(const Triangle &a, const Triangle &b)
{
  using namespace meeting_segment_detail;
  const triangles_meet_detail::SidesBy<Sign> of_a(b, a), of_b(a, b);
  if (of_a.all_on(0) || of_b.all_on(0) || of_a.apart() || of_b.apart())
    return {{0, 0, 0}, {0, 0, 0}, true};
  const Vec3 normal_a = unit_normal(a), normal_b = unit_normal(b);
  Vec3 x[2], y[2];
  cut(a, of_a, normal_b, b[0], x);
  cut(b, of_b, normal_a, a[0], y);
  const Vec3 along = cross(normal_a, normal_b);
  const auto ascend = [&](Vec3(&e)[2]) {
    if (!(dot(along, e[1] - e[0]) < 0)) return;
    const Vec3 first = e[0];
    e[0] = e[1];
    e[1] = first;
  };
  ascend(x);
  ascend(y);
  const Vec3 from = dot(along, y[0] - x[0]) > 0 ? y[0] : x[0],
             to = dot(along, y[1] - x[1]) < 0 ? y[1] : x[1];
  // If they only touch, rounding may put the end before the start.
  if (dot(along, to - from) < 0) return {to, to, false};
  return {from, to, false};
}

}    // namespace lsdcd
