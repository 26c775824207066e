// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grain that is an ellipsoid or a superellipsoid, in its own frame: its centre is the origin, its axes are x, y, z.
#pragma once

#include "shape/nested_norm.h"

namespace lsdcd {

// The body (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1, an ellipsoid where both exponents are 2. Made by
// make_superellipsoid().
struct Superellipsoid {
  Vec3 half;        // half-axes a, b, c > 0, length
  Real n1, n2;      // exponents, from 2 to 20: n1 along z, n2 in the plane of x and y
  Real rho;         // least radius of curvature, length: a ball of this radius rolls freely inside
  Real farthest;    // radius of the circumscribed sphere, length
  Real nearest;     // radius of the inscribed sphere, length

  LSDCD_FN bool is_ellipsoid() const { return n1 == 2 && n2 == 2; }
};

// Throws InputError for numbers that make no shape.
void check_shape(const Vec3 &half, Real n1, Real n2);
// Returns the shape, as checked.
Superellipsoid make_superellipsoid(const Vec3 &half, Real n1, Real n2);

// Returns the radius of the circumscribed sphere, length.
Real circumscribed_radius(const Vec3 &half, Real n1, Real n2);
// Returns the volume, length^3.
Real volume(const Superellipsoid &s);
// Returns the moments of inertia about the axes over the mass, at uniform density, length^2.
Vec3 inertia_over_mass(const Superellipsoid &s);

// The plane that touches the body from outside, with a normal.
struct SupportPlane {
  Real height;    // of the plane over the centre, the largest n.x of the body: length
  Vec3 point;     // of the body on it
};

// Returns the plane with the outward unit normal n.
LSDCD_FN SupportPlane support(const Superellipsoid &s, const Vec3 &n)
{
  const Vec3 u = {s.half.x * n.x, s.half.y * n.y, s.half.z * n.z};
  if (s.is_ellipsoid()) {
    const Real height = norm(u);
    const Real scale = 1 / height;
    return {height, {s.half.x * (scale * u.x), s.half.y * (scale * u.y), s.half.z * (scale * u.z)}};
  }
  const TwoNorm plane = two_norm(fabs(u.x), fabs(u.y), s.n2 / (s.n2 - 1));
  const TwoNorm all = two_norm(plane.value, fabs(u.z), s.n1 / (s.n1 - 1));
  return {all.value,
          {copysign(s.half.x * all.dx * plane.dx, n.x), copysign(s.half.y * all.dx * plane.dy, n.y),
           copysign(s.half.z * all.dy, n.z)}};
}

// How much the body has to grow to reach a point x: 1 on the surface, below 1 inside. With the derivatives by x, as
// those of NestedNorm.
LSDCD_FN NestedNorm gauge(const Superellipsoid &s, const Vec3 &x)
{
  const Vec3 inverse = {1 / s.half.x, 1 / s.half.y, 1 / s.half.z};
  const auto scaled = [&](const Vec3 &v) {
    return Vec3{inverse.x * v.x, inverse.y * v.y, inverse.z * v.z};
  };
  NestedNorm g = nested_norm(scaled(x), s.n1, s.n2);
  g.slope = scaled(g.slope);
  for (Vec3 &along : g.along) along = scaled(along);
  return g;
}

// Returns the gauge alone.
LSDCD_FN Real gauge_value(const Superellipsoid &s, const Vec3 &x)
{
  const Real plane = two_norm(fabs(x.x) / s.half.x, fabs(x.y) / s.half.y, s.n2).value;
  return two_norm(plane, fabs(x.z) / s.half.z, s.n1).value;
}

// The curvature of the surface at a point: of the sphere of radius r the mean is 1/r, the product 1/r^2.
struct Curvature {
  Real mean, product;

  // The larger of the two principal curvatures.
  LSDCD_FN Real largest() const { return mean + sqrt(fmax(mean * mean - product, Real(0))); }
};

// Returns the curvature at a point of the surface.
LSDCD_FN Curvature curvature_at(const Superellipsoid &s, const Vec3 &x)
{
  const NestedNorm g = gauge(s, x);
  const Real slope = norm(g.slope);
  const Vec3 n = (1 / slope) * g.slope;
  // Across the normal alone.
  Vec3 along[2];
  for (int k = 0; k < 2; k++) along[k] = g.along[k] - dot(n, g.along[k]) * n;
  const Real twist = dot(n, cross(along[0], along[1]));
  return {(g.bend[0] * norm_sq(along[0]) + g.bend[1] * norm_sq(along[1])) / (2 * slope),
          g.bend[0] * g.bend[1] * (twist / slope) * (twist / slope)};
}

// Returns the radius of curvature of the body's shadow along the direction across n and `turn`, both of length 1 and at right angles,
// where its outward normal is n: length. It is rho at least, and infinite over a flat side.
LSDCD_FN Real shadow_radius(const Superellipsoid &s, const Vec3 &n, const Vec3 &turn)
{
  const auto scaled = [&](const Vec3 &v) {
    return Vec3{s.half.x * v.x, s.half.y * v.y, s.half.z * v.z};
  };
  const NestedNorm h = nested_norm(scaled(n), s.n1 / (s.n1 - 1), s.n2 / (s.n2 - 1));
  Real radius = 0;
  for (int k = 0; k < 2; k++) {
    const Real part = dot(h.along[k], scaled(turn));
    if (part != 0) radius += h.bend[k] * part * part;
  }
  return radius;
}

}    // namespace lsdcd
