// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The norm (A^p1 + |z|^p1)^(1/p1) with A = (|x|^p2 + |y|^p2)^(1/p2), of which the gauge of a superellipsoid (exponents n1,
// n2) and its support function (n1/(n1 - 1), n2/(n2 - 1)) are made, with its first and second derivatives.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// A norm of two numbers >= 0, and its derivatives.
struct TwoNorm {
  Real value, dx, dy;
};

// Returns x^p, x >= 0; by products where p is a whole number, as most exponents of shapes are.
LSDCD_FN Real power_of(Real x, Real p)
{
  constexpr int kMost = 32;
  const int whole = p <= kMost ? static_cast<int>(p) : 0;
  if (whole != p) return pow(x, p);
  Real power = 1;
  for (int left = whole; left > 0; left >>= 1, x *= x)
    if (left & 1) power *= x;
  return power;
}

// Only ratios are raised to powers, so that nothing leaves the range of Real. p >= 1.
LSDCD_FN TwoNorm two_norm(Real x, Real y, Real p)
{
  const bool swapped = x < y;
  const Real large = swapped ? y : x, small = swapped ? x : y;
  if (!(large > 0)) return {0, 0, 0};
  const Real ratio = small / large;
  Real value, d_large, d_small;
  if (p == 2) {
    const Real root = sqrt(1 + ratio * ratio);
    value = large * root;
    d_large = 1 / root;
    d_small = ratio / root;
  } else {
    const Real power = power_of(ratio, p), root = pow(1 + power, 1 / p);
    value = large * root;
    d_large = root / (1 + power);
    d_small = ratio > 0 ? power / ratio * d_large : 0;
  }
  return swapped ? TwoNorm{value, d_small, d_large} : TwoNorm{value, d_large, d_small};
}

// The second derivatives are bend[0] along[0] along[0]^T + bend[1] along[1] along[1]^T. Where p < 2 a bend is infinite
// where a number is 0.
struct NestedNorm {
  Real value;
  Vec3 slope;
  Real bend[2];
  Vec3 along[2];
};

// x^(p - 2) from d = x^(p - 1).
LSDCD_FN Real power_below(Real d, Real x, Real p)
{
  if (p == 2) return 1;
  if (x > 0) return d / x;
  return p > 2 ? 0 : HUGE_VAL;
}

LSDCD_FN NestedNorm nested_norm(const Vec3 &x, Real p1, Real p2)
{
  const Vec3 sign = {x.x < 0 ? -1.0 : 1.0, x.y < 0 ? -1.0 : 1.0, x.z < 0 ? -1.0 : 1.0};
  const TwoNorm plane = two_norm(fabs(x.x), fabs(x.y), p2);
  const TwoNorm all = two_norm(plane.value, fabs(x.z), p1);
  NestedNorm norm;
  norm.value = all.value;
  norm.slope = {sign.x * all.dx * plane.dx, sign.y * all.dx * plane.dy, sign.z * all.dy};
  // Shares of the two norms, whose powers add up to 1. Along z nothing tells x from y.
  const bool on_axis = !(plane.value > 0);
  const Real a = plane.value / all.value, z = fabs(x.z) / all.value;
  const Real fx = on_axis ? 1 : fabs(x.x) / plane.value, fy = on_axis ? 0 : fabs(x.y) / plane.value;
  const Real a_below = power_below(all.dx, a, p1);
  norm.bend[0] = (p1 - 1) / all.value * a_below * power_below(all.dy, z, p1);
  norm.along[0] = {sign.x * z * (on_axis ? 1 : plane.dx), sign.y * z * plane.dy, -sign.z * a};
  norm.bend[1] = (p2 - 1) / all.value * a_below * power_below(on_axis ? 1 : plane.dx, fx, p2) *
                 power_below(plane.dy, fy, p2);
  norm.along[1] = {sign.x * fy, -sign.y * fx, 0};
  return norm;
}

}    // namespace lsdcd
