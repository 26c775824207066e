// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The point of a grain's surface nearest to a point y, in the grain's frame, and the signed distance of y, below 0 inside.
// The signed distance is the largest n.y - h(n) over all unit n, with h of support(), so that it is convex in y.
#pragma once

#include "shape/superellipsoid.h"

namespace lsdcd {

struct SurfacePoint {
  Real distance;    // signed, of y: length
  Vec3 normal;      // outward unit normal of the surface: the gradient of the signed distance
  Vec3 point;       // of the surface
  bool is_sure;     // no other point of the surface is nearer
};

// Returns the point of an ellipsoid nearest to y. It is x_i = a_i^2 y_i / (a_i^2 + s) with the largest s for which it is on
// the surface; with t = s + m^2, m the least half-axis, that is the root of |v| = 1, v_i = a_i y_i / (a_i^2 - m^2 + t).
// Newton's steps on 1/|v| = 1 from below grow towards it.
LSDCD_FN SurfacePoint nearest_on_ellipsoid(const Vec3 &half, const Vec3 &y)
{
  const int least = half.x <= half.y ? (half.x <= half.z ? 0 : 2) : (half.y <= half.z ? 1 : 2);
  const Real m = half[least];
  Vec3 more;    // a_i^2 - m^2
  Real t = 0;
  for (int k = 0; k < 3; k++) {
    more[k] = (half[k] - m) * (half[k] + m);
    t = fmax(t, half[k] * fabs(y[k]) - more[k]);
  }
  Real below = HUGE_VAL;    // |v| of the last step, which falls
  Vec3 over, v;             // a_i^2 + s
  constexpr int kMostSteps = 100;
  for (int i = 0; i < kMostSteps; i++) {
    Real square = 0, change = 0;
    for (int k = 0; k < 3; k++) {
      over[k] = more[k] + t;
      v[k] = y[k] == 0 ? 0 : half[k] * y[k] / over[k];
      square += v[k] * v[k];
      if (y[k] != 0) change += v[k] * v[k] / over[k];
    }
    const Real size = sqrt(square);
    if (!(size > 1) || !(size < below)) break;
    below = size;
    t += square / change * (size - 1);
  }
  SurfacePoint nearest;
  nearest.is_sure = true;
  if (t > 0) {
    Vec3 n;
    for (int k = 0; k < 3; k++) n[k] = y[k] == 0 ? 0 : y[k] / over[k];
    const Real size = norm(n);
    nearest.normal = (1 / size) * n;
    nearest.distance = (t - m * m) * size;
    nearest.point = {half.x * v.x, half.y * v.y, half.z * v.z};
    return nearest;
  }
  // y is in the middle, where two points mirrored along the least half-axis are equally near.
  const Real rest = sqrt(fmax(1 - norm_sq(v), Real(0)));
  v[least] = rest;
  nearest.point = {half.x * v.x, half.y * v.y, half.z * v.z};
  const Vec3 n = {v.x / half.x, v.y / half.y, v.z / half.z};
  nearest.normal = (1 / norm(n)) * n;
  nearest.distance = -norm(nearest.point - y);
  return nearest;
}

// Signed distances up to this, by their rounding, are 0.
LSDCD_FN Real on_surface(const Superellipsoid &s)
{
  return 64 * kRoundoff * s.farthest;
}

// Follows the surface downhill in the distance to y from x, a point of the surface, by Newton's steps for a local minimum,
// shortened until the distance falls. The step has the curvature of the surface in it: across the normal it solves
// (1 - l H) step = -(x - y), l the multiplier of the gauge, H its second derivatives.
class SurfaceDescent {
 public:
  LSDCD_FN SurfaceDescent(const Superellipsoid &s, const Vec3 &y) : s_(s), y_(y) {}

  // Returns the local minimum; is_sure says no more than that it converged.
  LSDCD_FN SurfacePoint from(const Vec3 &start)
  {
    constexpr int kMostSteps = 60, kMostHalvings = 30;
    const Real small = 4 * kRoundoff * s_.farthest;
    go_to(start);
    bool converged = false;
    for (int i = 0; i < kMostSteps && !converged; i++) {
      const Vec3 step = newton_step();
      const Real length = norm(step);
      const Vec3 from = x_, before = away_;
      if (!(length - length == 0)) break;
      converged = length <= small;
      go_to(from + step);
      // Below this the distance is flat to rounding.
      if (length <= 1e-7 * s_.farthest) continue;
      Real share = 1;
      // The change of the square of the distance, without its rounding.
      for (int half = 0; half < kMostHalvings && !(dot(x_ - from, away_ + before) < 0); half++)
        go_to(from + (share *= 0.5) * step);
    }
    return {-dot(normal_, away_), normal_, x_, converged};
  }

 private:
  // Goes to the point of the surface over x.
  LSDCD_FN void go_to(const Vec3 &x)
  {
    g_ = gauge(s_, x);
    x_ = (1 / g_.value) * x;
    slope_ = norm(g_.slope);
    normal_ = (1 / slope_) * g_.slope;
    away_ = x_ - y_;
  }
  LSDCD_FN Vec3 newton_step() const
  {
    const Vec3 one = any_perpendicular(normal_), two = cross(normal_, one);
    const Real along = dot(normal_, away_);
    // l of the gauge over its slope there, as its second derivatives are those at g_.value times the point.
    const Real l = along / slope_ * g_.value;
    Real a = 1, b = 0, d = 1;
    for (int k = 0; k < 2; k++) {
      const Real p = dot(g_.along[k], one), q = dot(g_.along[k], two), bend = l * g_.bend[k];
      a -= bend * p * p;
      b -= bend * p * q;
      d -= bend * q * q;
    }
    const Real u = -dot(one, away_), v = -dot(two, away_);
    const Real det = a * d - b * b;
    if (!(a > 0 && det > 0)) return u * one + v * two;
    return ((d * u - b * v) / det) * one + ((a * v - b * u) / det) * two;
  }

  const Superellipsoid &s_;
  const Vec3 y_;
  NestedNorm g_;
  Vec3 x_, normal_, away_;
  Real slope_;
};

// Searches all of the surface for the point nearest to y, which is inside: the octant of y is cut into triangles, and those
// that may have a nearer point into four, down to sides of 1/170 of an axis, from where descents start. The surface over a
// triangle of three of its points lies beyond its plane and between the planes through the centre and its sides, which
// bounds how near it is.
class SurfaceSearch {
 public:
  LSDCD_FN SurfaceSearch(const Superellipsoid &s, const Vec3 &y) : s_(s), y_(y) {}

  LSDCD_FN SurfacePoint run()
  {
    // The search is in the first octant, as the shape is its own mirror image.
    const Vec3 mirrored = y_;
    y_ = {fabs(y_.x), fabs(y_.y), fabs(y_.z)};
    best_ = {-HUGE_VAL, {0, 0, 0}, {0, 0, 0}, false};
    descend(gauge_value(s_, y_) > 0 ? y_ : s_.half);
    Patch waiting[kMostWaiting];
    int n = 0;
    waiting[n++] = {{{s_.half.x, 0, 0}, {0, s_.half.y, 0}, {0, 0, s_.half.z}}, 0};
    while (n > 0) {
      const Patch patch = waiting[--n];
      if (!may_have_nearer(patch)) continue;
      if (patch.level == kFirstDescent || patch.level == kLastLevel) {
        descend(patch.corner[0] + patch.corner[1] + patch.corner[2]);
        if (patch.level == kLastLevel || !may_have_nearer(patch)) continue;
      }
      const Vec3 middle[3] = {between(patch, 0), between(patch, 1), between(patch, 2)};
      const int level = patch.level + 1;
      for (int k = 0; k < 3; k++)
        waiting[n++] = {{patch.corner[k], middle[k], middle[k == 0 ? 2 : k - 1]}, level};
      waiting[n++] = {{middle[0], middle[1], middle[2]}, level};
    }
    best_.normal = mirror(best_.normal, mirrored);
    best_.point = mirror(best_.point, mirrored);
    return best_;
  }

 private:
  // Gives v, of the first octant, the signs of `of`.
  LSDCD_FN static Vec3 mirror(const Vec3 &v, const Vec3 &of)
  {
    return {copysign(v.x, of.x), copysign(v.y, of.y), copysign(v.z, of.z)};
  }
  static constexpr int kFirstDescent = 5, kLastLevel = 8;
  static constexpr int kMostWaiting = 3 * (kLastLevel + 1) + 1;

  struct Patch {
    Vec3 corner[3];    // of the surface
    int level;
  };

  LSDCD_FN Vec3 between(const Patch &patch, int k) const
  {
    const Vec3 x = patch.corner[k] + patch.corner[k == 2 ? 0 : k + 1];
    return (1 / gauge_value(s_, x)) * x;
  }
  // Tries the local minimum downhill from here.
  LSDCD_FN void descend(const Vec3 &x)
  {
    const SurfacePoint local = SurfaceDescent(s_, y_).from(x);
    if (local.is_sure && local.distance <= on_surface(s_) && local.distance > best_.distance)
      best_ = local;
  }
  LSDCD_FN bool may_have_nearer(const Patch &patch) const
  {
    const Real nearer = -best_.distance - 1e-13 * s_.farthest;
    const Vec3 *c = patch.corner;
    const Vec3 plane = cross(c[1] - c[0], c[2] - c[0]);
    const Real out = dot(plane, c[0]) < 0 ? -1 : 1;
    if (out * dot(plane, c[0] - y_) > nearer * norm(plane)) return false;
    for (int k = 0; k < 3; k++) {
      const Vec3 side = cross(c[k], c[k == 2 ? 0 : k + 1]);
      if (-out * dot(side, y_) > nearer * norm(side)) return false;
    }
    return true;
  }

  const Superellipsoid &s_;
  Vec3 y_;
  SurfacePoint best_;
};

// Returns the point of the surface nearest to y. One point where a local minimum less deep than rho is found: a ball of
// that depth about y touches the surface there, and rolls inside a ball of radius rho that is within the surface. Outside
// there is one local minimum on the near side.
LSDCD_FN SurfacePoint nearest_on_surface(const Superellipsoid &s, const Vec3 &y)
{
  if (s.is_ellipsoid()) return nearest_on_ellipsoid(s.half, y);
  const Real g = gauge_value(s, y);
  if (g > 0) {
    Vec3 start = (1 / g) * y;
    if (g > 1) {
      // From far away the normal is known better than the point.
      const Vec3 away = y - start, other = support(s, (1 / norm(away)) * away).point;
      if (norm_sq(y - other) < norm_sq(away)) start = other;
    }
    const SurfacePoint local = SurfaceDescent(s, y).from(start);
    const bool is_near_side = local.distance >= -on_surface(s);
    if (local.is_sure && (is_near_side || (g < 1 && -local.distance < s.rho))) return local;
    if (g > 1) return {local.distance, local.normal, local.point, false};
  }
  return SurfaceSearch(s, y).run();
}

}    // namespace lsdcd
