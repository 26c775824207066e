// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "shape/superellipsoid.h"

#include "base/input_error.h"
#include "base/vector_text.h"
#include "shape/largest_on_surface.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {
namespace {

constexpr Real kLeastExponent = 2, kMostExponent = 20;
// Products of four half-axes stay in the range of Real.
constexpr Real kLeastHalf = 1e-70, kMostHalf = 1e70;

Real beta(Real x, Real y)
{
  return std::exp(std::lgamma(x) + std::lgamma(y) - std::lgamma(x + y));
}

// The largest sum of two numbers x a + y b, (x, y) of the unit circle of exponent n >= 2: the dual norm of (x^2 + y^2).
Real farthest_of_two(Real a, Real b, Real n)
{
  if (n == 2) return std::max(a, b);
  const Real p = 2 * n / (n - 2), large = std::max(a, b);
  return large * std::pow(1 + std::pow(std::min(a, b) / large, p), 1 / p);
}

}    // namespace

void check_shape(const Vec3 &half, Real n1, Real n2)
{
  for (int k = 0; k < 3; k++)
    if (!(half[k] >= kLeastHalf && half[k] <= kMostHalf))
      throw InputError("a half-axis of a shape is " + number_text(half[k]) +
                       ": half-axes are lengths above 0");
  for (Real n : {n1, n2})
    if (!(n >= kLeastExponent && n <= kMostExponent))
      throw InputError("an exponent of a shape is " + number_text(n) +
                       ": exponents are from 2, an ellipsoid, to 20");
}

Superellipsoid make_superellipsoid(const Vec3 &half, Real n1, Real n2)
{
  check_shape(half, n1, n2);
  const Real least = std::min({half.x, half.y, half.z}), most = std::max({half.x, half.y, half.z});
  Superellipsoid s = {half, n1, n2, 0, 0, least};
  s.farthest = circumscribed_radius(half, n1, n2);
  const auto curvature = [&s](const Vec3 &x) { return curvature_at(s, x).largest(); };
  s.rho = s.is_ellipsoid() ? least * (least / most) : 1 / largest_on_surface(s, curvature);
  return s;
}

Real circumscribed_radius(const Vec3 &half, Real n1, Real n2)
{
  return farthest_of_two(farthest_of_two(half.x, half.y, n2), half.z, n1);
}

// Jaklic, Leonardis and Solina, Segmentation and Recovery of Superquadrics, 2000, chapter 2.
Real volume(const Superellipsoid &s)
{
  const Real e1 = 2 / s.n1, e2 = 2 / s.n2;
  return 2 * s.half.x * s.half.y * s.half.z * e1 * e2 * beta(e1 / 2 + 1, e1) * beta(e2 / 2, e2 / 2);
}

Vec3 inertia_over_mass(const Superellipsoid &s)
{
  const Real e1 = 2 / s.n1, e2 = 2 / s.n2;
  const Real all = 4 * beta(e1 / 2 + 1, e1) * beta(e2 / 2, e2 / 2);
  // Means of x^2 over a^2 (and of y^2 over b^2), and of z^2 over c^2.
  const Real across = beta(3 * e2 / 2, e2 / 2) * beta(e1 / 2, 2 * e1 + 1) / all,
             along = 4 * beta(e2 / 2, e2 / 2 + 1) * beta(3 * e1 / 2, e1 + 1) / all;
  const Vec3 square = {across * s.half.x * s.half.x, across * s.half.y * s.half.y,
                       along * s.half.z * s.half.z};
  return {square.y + square.z, square.z + square.x, square.x + square.y};
}

}    // namespace lsdcd
