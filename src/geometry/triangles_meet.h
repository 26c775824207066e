// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Do two triangles have a common point? It is exact, as it uses only signs of orientation(). The test is the one that the paper
// takes (section 3.7).
#pragma once

#include "geometry/orientation.h"

namespace lsdcd {

// Its sides and corners are part of it. It may be a segment or a point.
struct Triangle {
  Vec3 corner[3];

  LSDCD_FN const Vec3 &operator[](int k) const { return corner[k]; }
};

namespace triangles_meet_detail {

// Signs of four points: exact, or 0 if rounded numbers do not decide.
struct ExactSign {
  LSDCD_FN static int of(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
  {
    return orientation(a, b, c, d);
  }
};
struct RoundedSign {
  LSDCD_FN static int of(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d)
  {
    return rounded_orientation(a, b, c, d);
  }
};

// The sides of a triangle's plane on which the corners of another are.
template <class Sign>
struct SidesBy {
  int of[3];

  LSDCD_FN SidesBy(const Triangle &plane, const Triangle &t)
  {
    for (int k = 0; k < 3; k++) of[k] = Sign::of(plane[0], plane[1], plane[2], t[k]);
  }
  LSDCD_FN bool all_on(int side) const { return of[0] == side && of[1] == side && of[2] == side; }
  LSDCD_FN bool apart() const { return all_on(1) || all_on(-1); }
  // The corner that the plane separates from the two others, unless all are on one side or in it.
  LSDCD_FN int alone() const
  {
    for (int k = 0; k < 2; k++)
      if (side_of(k) != 0) return k;
    return 2;
  }
  // Its side, where it is one.
  LSDCD_FN int side_of(int k) const
  {
    const int i = of[(k + 1) % 3], j = of[(k + 2) % 3];
    if (of[k] == 0) return i * j > 0 ? -i : 0;
    return i * of[k] <= 0 && j * of[k] <= 0 ? of[k] : 0;
  }
};
using Sides = SidesBy<ExactSign>;

// Devillers and Guigue (2002). Precondition: the planes cut each other, and each triangle reaches both sides of the
// other's plane, or touches it. Corners are permuted so that corner 0 is alone on its side, and the other's winding
// so that this is the positive side. On the common line of the planes each triangle has an interval. The intervals
// overlap if neither of two orientation signs is 1; the larger sign is returned.
template <class Sign>
LSDCD_FN int crossing(const Triangle &a, const Triangle &b, const SidesBy<Sign> &of_a,
                      const SidesBy<Sign> &of_b)
{
  const int i = of_a.alone(), j = of_b.alone();
  const int flip_b = of_a.side_of(i) < 0, flip_a = of_b.side_of(j) < 0;
  const Vec3 &a0 = a[i], &a1 = a[(i + 1 + flip_a) % 3], &a2 = a[(i + 2 - flip_a) % 3];
  const Vec3 &b0 = b[j], &b1 = b[(j + 1 + flip_b) % 3], &b2 = b[(j + 2 - flip_b) % 3];
  const int first = Sign::of(a0, a1, b0, b1);
  if (first > 0) return first;
  const int second = Sign::of(a0, a2, b2, b0);
  return first > second ? first : second;
}

LSDCD_FN bool boxes_overlap(const Vec3 *a, int n_a, const Vec3 *b, int n_b)
{
  for (int k = 0; k < 3; k++) {
    Real a_lo = a[0][k], a_hi = a_lo, b_lo = b[0][k], b_hi = b_lo;
    for (int i = 1; i < n_a; i++) a_lo = fmin(a_lo, a[i][k]), a_hi = fmax(a_hi, a[i][k]);
    for (int i = 1; i < n_b; i++) b_lo = fmin(b_lo, b[i][k]), b_hi = fmax(b_hi, b[i][k]);
    if (a_lo > b_hi || b_lo > a_hi) return false;
  }
  return true;
}

// An axis that is not parallel to the plane of these points; -1: they are all on one
// line.
LSDCD_FN int axis_of_plane(const Vec3 *x, int n)
{
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      for (int k = j + 1; k < n; k++)
        for (int axis = 0; axis < 3; axis++)
          if (orientation_along(axis, x[i], x[j], x[k]) != 0) return axis;
  return -1;
}

// Do two segments of one plane, projected along an axis, meet? Neither is past the other, and neither
// on one side of the other's line. A segment may be a point.
LSDCD_FN bool segments_meet(int axis, const Vec3 *s, const Vec3 *t)
{
  return boxes_overlap(s, 2, t, 2) &&
         orientation_along(axis, s[0], s[1], t[0]) * orientation_along(axis, s[0], s[1], t[1]) <=
             0 &&
         orientation_along(axis, t[0], t[1], s[0]) * orientation_along(axis, t[0], t[1], s[1]) <= 0;
}

// Is a point of its plane in a triangle, projected along an axis? Never in one that is a segment.
LSDCD_FN bool covers(int axis, const Triangle &t, const Vec3 &x)
{
  if (orientation_along(axis, t[0], t[1], t[2]) == 0) return false;
  int lowest = 1, highest = -1;
  for (int k = 0; k < 3; k++) {
    const int side = orientation_along(axis, t[k], t[(k + 1) % 3], x);
    lowest = side < lowest ? side : lowest;
    highest = side > highest ? side : highest;
  }
  return lowest * highest >= 0;
}

// Triangles, segments or points in one plane: two sides meet, or one holds the other.
LSDCD_FN bool meet_in_plane(const Triangle &a, const Triangle &b)
{
  const Vec3 all[6] = {a[0], a[1], a[2], b[0], b[1], b[2]};
  if (!boxes_overlap(a.corner, 3, b.corner, 3)) return false;
  const int axis = axis_of_plane(all, 6);
  if (axis < 0) return true;    // intervals of one line are their boxes
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const Vec3 s[2] = {a[i], a[(i + 1) % 3]}, t[2] = {b[j], b[(j + 1) % 3]};
      if (segments_meet(axis, s, t)) return true;
    }
  return covers(axis, a, b[0]) || covers(axis, b, a[0]);
}

// A triangle with an area, and a segment: in its plane, or through it at one point.
LSDCD_FN bool segment_meets(const Triangle &t, const Vec3 &p, const Vec3 &q)
{
  const int at_p = orientation(t[0], t[1], t[2], p), at_q = orientation(t[0], t[1], t[2], q);
  if (at_p * at_q > 0) return false;
  if (at_p == 0 && at_q == 0) return meet_in_plane(t, {{p, q, q}});
  bool left = false, right = false;
  for (int k = 0; k < 3; k++) {
    const int side = orientation(p, q, t[k], t[(k + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

LSDCD_FN bool is_flat(const Triangle &t)
{
  return axis_of_plane(t.corner, 3) < 0;
}

LSDCD_FN bool any_side_meets(const Triangle &t, const Triangle &segment)
{
  for (int k = 0; k < 3; k++)
    if (segment_meets(t, segment[k], segment[(k + 1) % 3])) return true;
  return false;
}

LSDCD_FN bool in_one_plane(const Triangle &a, const Triangle &b)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      if (orientation(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]) != 0) return false;
  return true;
}

// The corners of one are all in the plane of the other, which may be a segment or a point.
inline LSDCD_NOINLINE bool meet_flat(const Triangle &a, const Triangle &b)
{
  const bool flat_a = is_flat(a), flat_b = is_flat(b);
  if (flat_a && flat_b) return in_one_plane(a, b) && meet_in_plane(a, b);
  if (flat_a) return any_side_meets(b, a);
  if (flat_b) return any_side_meets(a, b);
  return meet_in_plane(a, b);
}

}    // namespace triangles_meet_detail

LSDCD_FN bool triangles_meet(const Triangle &a, const Triangle &b)
{
  using namespace triangles_meet_detail;
  if (!boxes_overlap(a.corner, 3, b.corner, 3)) return false;
  const Sides of_a(b, a);
  if (of_a.apart()) return false;
  const Sides of_b(a, b);
  if (of_b.apart()) return false;
  if (of_a.all_on(0) || of_b.all_on(0)) return meet_flat(a, b);
  return crossing(a, b, of_a, of_b) <= 0;
}

// Do the triangles meet, by rounded signs alone? Returns 1 for yes, -1 for no, 0 if they do not decide.
LSDCD_FN int triangles_meet_rounded(const Triangle &a, const Triangle &b)
{
  using namespace triangles_meet_detail;
  if (!boxes_overlap(a.corner, 3, b.corner, 3)) return -1;
  const SidesBy<RoundedSign> of_a(b, a);
  if (of_a.apart()) return -1;
  const SidesBy<RoundedSign> of_b(a, b);
  if (of_b.apart()) return -1;
  for (int k = 0; k < 3; k++)
    if (of_a.of[k] == 0 || of_b.of[k] == 0) return 0;
  return -crossing(a, b, of_a, of_b);
}

// Is a point on a triangle?
LSDCD_FN bool lies_on(const Triangle &t, const Vec3 &x)
{
  return orientation(t[0], t[1], t[2], x) == 0 &&
         triangles_meet_detail::meet_in_plane(t, {{x, x, x}});
}

}    // namespace lsdcd
