// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Folds of all angles: the force is as smooth in position and in angle as one wall's.
// (test_corners: the closed form at each angle.)
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace lsdcd::test_nearly_flat {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5;
constexpr const char *kTheme = "Nearly flat";

Real radians(Real degrees)
{
  return degrees * kPi / 180;
}
std::string text(Real value)
{
  char out[32];
  std::snprintf(out, sizeof out, "%g", value);
  return out;
}

std::vector<Vec3> forces(const TriangleSoup &soup, const std::vector<Vec3> &at)
{
  Scene scene(soup, kRadius, hooke(kStiffness), 0, 0);
  for (const Vec3 &x : at) scene.add_sphere(x, kRadius, 1);
  scene.compute(1e-4);
  std::vector<Vec3> f;
  for (int i = 0; i < scene.n(); i++) f.push_back(scene.force(i));
  return f;
}

// Roundings of two forces: of positions and overlaps; and on a shallow fold, where
// the way that two walls share a force hangs on their difference over the angle, a
// turn by the rounding over the angle, never by more than the angle.
Real rounding(Real degrees, Real deepest)
{
  const Real a = std::fabs(radians(degrees));
  return 2 * kStiffness * kRadius *
         (32 * kRoundoff + std::fmin(a * deepest / kRadius, 64 * kRoundoff / a));
}

// A centre over the hinge, up to `deepest` into each half and at all distances from
// the fold.
Vec3 over_hinge(Random &random, Real degrees, Real deepest)
{
  const Real a = radians(degrees), depth = deepest * uniform(random, 0, 1);
  const Real aside = log_uniform(random, 1e-10, 0.3) * (random() % 2 ? 1 : -1);
  const Real y = uniform(random, -0.5, 0.5), h = kRadius - depth;
  if (degrees < 0) {    // convex: anywhere round the edge
    const Real turn = a * uniform(random, -0.2, 1.2);
    const Vec3 n = {-std::sin(turn), 0, std::cos(turn)};
    if (random() % 2) return Vec3{0, y, 0} + h * n;
    return {aside, y, h};
  }
  // Concave: h above the left half and at least h - depth above the right one, about
  // where both are as near.
  const Real middle = -h * std::tan(a / 2);
  return {middle + std::fmin(aside, depth / std::sin(a)), y, h};
}

// ---- in position --------------------------------------------------------------------------

TEST(fold, changes_the_force_by_no_more_than_stiffness_times_the_step)
{
  // Where both walls bear, F.n = k d for each of them: F follows the centre with
  // stiffness k. One wall: k along its normal. An edge: k along the radius and
  // k d / h across it, less than k while d < h. Walls at more than a right angle
  // add up: k (1 + |cos|).
  const Real deepest = 0.1 * kRadius;
  constexpr int kPairs = 20000;
  for (Real size : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1., 5., 15., 45., 80., 90., 120.}) {
    Real largest = 0;
    for (Real degrees : {size, -size}) {
      Random random(1);
      std::vector<Vec3> at;
      for (int i = 0; i < kPairs; i++) {
        const Vec3 x = over_hinge(random, degrees, deepest);
        const Vec3 d = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        at.push_back(x);
        at.push_back(x + log_uniform(random, 1e-9, 1e-2) * unit(d));
      }
      const std::vector<Vec3> f = forces(hinge_mesh(degrees, 3), at);
      const Real stiffest =
          kStiffness * (degrees > 90 ? 1 + std::fabs(std::cos(radians(degrees))) : 1);
      int touching = 0;
      for (std::size_t i = 0; i < f.size(); i += 2) {
        const Real step = norm(at[i + 1] - at[i]);
        // A step of 1e-2 may go deeper than the deepest start.
        const Real room = rounding(degrees, deepest + 1e-2);
        const Real ratio = norm(f[i + 1] - f[i]) / (stiffest * step + room);
        if (!(ratio <= largest)) largest = ratio;
        touching += norm_sq(f[i]) > 0;
      }
      EXPECT_GT(touching, kPairs / 2) << degrees;
    }
    expect_at_most({kTheme, "1", "folds of +-" + text(size) + " degrees: |dF| / (k |dx|)"}, largest,
                   1 + 1e-6 + 1e-9,
                   "two walls: F.n = k d each to 1e-6, by which cover is less than the cosine; an "
                   "edge: k and k d/h < k");
  }
}

// ---- in angle ------------------------------------------------------------------------------

TEST(fold, changes_the_force_by_no_more_than_its_turn)
{
  // Turning the right wall by da moves it by e da at the closest point, e off the fold, and
  // its normal by da. One wall: k (e + d) da. Both: F.n of the left stays, so that
  // F moves by k (e da - F.t da) / sin a with e < h sin a, F.t < k d sin a, in
  // all k R da / cos(a/2)^2 at most; from a right angle on the sum, k (e + d) da.
  const Real deepest = 0.1 * kRadius, far = 0.3 + kRadius;
  constexpr int kPositions = 2000;
  for (Real more : {1e-9, 1e-6, 1e-3, 0.5}) {
    Real largest = 0;
    for (Real size : {0., 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1., 5., 15., 45., 80., 89., 90., 91.})
      for (Real degrees : {size, -size}) {
        Random random(2);
        std::vector<Vec3> at;
        for (int i = 0; i < kPositions; i++)
          at.push_back(over_hinge(random, degrees + more, deepest));
        const std::vector<Vec3> f = forces(hinge_mesh(degrees, 3), at),
                                g = forces(hinge_mesh(degrees + more, 3), at);
        const Real bound = 2 * kStiffness * (far + kRadius) * radians(more);
        const Real a = std::fmax(std::fabs(degrees), std::fabs(degrees + more));
        const Real b = std::fmin(std::fabs(degrees), std::fabs(degrees + more));
        const Real room = rounding(a, deepest) + (b > 0 ? rounding(b, deepest) : 0);
        for (int i = 0; i < kPositions; i++) {
          const Real ratio = norm(g[i] - f[i]) / (bound + room);
          if (!(ratio <= largest)) largest = ratio;
        }
      }
    expect_at_most(
        {kTheme, "2",
         "folds of -91 to 91 degrees turned by " + text(more) + ": |dF| / (2 k (e + R) da)"},
        largest, 1, "a wall turned by da moves by e da and its normal by da");
  }
}

// ---- from a right angle on ---------------------------------------------------------------------

TEST(walls, from_a_right_angle_on_add_up)
{
  Random random(3);
  for (Real degrees : {90., 90.001, 100., 120., 150., 170.}) {
    const Real a = radians(degrees);
    const Vec3 n0 = {0, 0, 1}, n1 = {-std::sin(a), 0, std::cos(a)};
    std::vector<Vec3> at;
    std::vector<std::array<Real, 2>> overlap;
    for (int i = 0; i < 5000; i++) {
      // x from the two heights: x.n0 = h0, x.n1 = h1.
      const Real h0 = kRadius - log_uniform(random, 5e-3, 0.05),
                 h1 = kRadius - log_uniform(random, 5e-3, 0.05);
      const Vec3 x = {(h0 * std::cos(a) - h1) / std::sin(a), uniform(random, -1, 1), h0};
      at.push_back(x);
      overlap.push_back({kRadius - dot(x, n0), kRadius - dot(x, n1)});
    }
    const std::vector<Vec3> f = forces(hinge_mesh(degrees, 8), at);
    Real largest = 0;
    for (std::size_t i = 0; i < f.size(); i++) {
      const Vec3 sum = kStiffness * (overlap[i][0] * n0 + overlap[i][1] * n1);
      const Real off = norm(f[i] - sum) / (kStiffness * (overlap[i][0] + overlap[i][1]));
      if (!(off <= largest)) largest = off;
    }
    expect_at_most({kTheme, "3", "two walls at " + text(degrees) + " degrees: |F/(F1 + F2) - 1|"},
                   largest, 1e-12, "roundings of overlaps of 1e-2 R: 16 eps / 1e-2");
  }
}

// Three walls between three edges that leave the origin.
TriangleSoup corner_of(const std::array<Vec3, 3> &edge)
{
  TriangleSoup soup;
  soup.source = "corner";
  for (int k = 0; k < 3; k++) {
    const Vec3 a = 6 * edge[k], b = 6 * edge[(k + 1) % 3];
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, a, a + b});
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, a + b, b});
  }
  return soup;
}

TEST(walls, three_from_right_angles_on_add_up)
{
  Random random(4);
  // Edges at `lean` from a common axis: upright ones make a box's corner, steeper
  // ones walls at more than a right angle to each other.
  const Real box = std::acos(1 / std::sqrt(3.));
  for (Real lean : {box, 0.999 * box, 0.9 * box, 0.7 * box}) {
    const Vec3 axis = unit({0.3, -0.5, 0.8}), u = unit(cross(axis, Vec3{1, 0, 0})),
               v = cross(axis, u);
    std::array<Vec3, 3> edge, n;
    for (int k = 0; k < 3; k++) {
      const Real b = 2 * kPi * k / 3 + 0.4;
      edge[k] = std::cos(lean) * axis + std::sin(lean) * (std::cos(b) * u + std::sin(b) * v);
    }
    for (int k = 0; k < 3; k++) n[k] = unit(cross(edge[k], edge[(k + 1) % 3]));
    const Vec3 c01 = cross(n[0], n[1]), c12 = cross(n[1], n[2]), c20 = cross(n[2], n[0]);
    std::vector<Vec3> at, expected;
    for (int i = 0; i < 5000; i++) {
      Real h[3];
      for (Real &x : h) x = kRadius - log_uniform(random, 5e-3, 0.05);
      const Vec3 x = (1 / dot(n[0], c12)) * (h[0] * c12 + h[1] * c20 + h[2] * c01);
      Vec3 sum = {0, 0, 0};
      for (int k = 0; k < 3; k++) sum += kStiffness * (kRadius - dot(x, n[k])) * n[k];
      at.push_back(x);
      expected.push_back(sum);
    }
    const std::vector<Vec3> f = forces(corner_of(edge), at);
    Real largest = 0;
    for (std::size_t i = 0; i < f.size(); i++) {
      const Real off = norm(f[i] - expected[i]) / norm(expected[i]);
      if (!(off <= largest)) largest = off;
    }
    const Real degrees = std::acos(dot(n[0], n[1])) * 180 / kPi;
    expect_at_most({kTheme, "4", "three walls at " + text(degrees) + " degrees: |F/sum - 1|"},
                   largest, 1e-12, "roundings of overlaps of 1e-2 R: 16 eps / 1e-2");
  }
}

// ---- a fold cut otherwise ------------------------------------------------------------------------

// The hinge with n strips on the left and m on the right: T-junctions along the fold.
TriangleSoup cut_hinge(Real degrees, Real half, int n, int m)
{
  TriangleSoup soup;
  soup.source = "cut hinge";
  const Real a = radians(degrees), x = half * std::cos(a), z = half * std::sin(a);
  const auto strips = [&](const Vec3 &far, int count) {
    for (int i = 0; i < count; i++) {
      const Vec3 p = {0, -half + 2 * half * i / count, 0},
                 q = {0, -half + 2 * half * (i + 1) / count, 0};
      soup.corners.insert(soup.corners.end(), {p, q, q + far});
      soup.corners.insert(soup.corners.end(), {p, q + far, p + far});
    }
  };
  strips({-half, 0, 0}, n);
  strips({x, 0, z}, m);
  return soup;
}

TEST(fold, with_t_junctions_along_it_is_the_same_fold)
{
  const Real deepest = 0.1 * kRadius;
  Real largest = 0;
  for (Real size : {1e-6, 1e-4, 1e-2, 1., 15., 60., 90., 120.})
    for (Real degrees : {size, -size}) {
      Random random(5);
      std::vector<Vec3> at;
      for (int i = 0; i < 10000; i++) at.push_back(over_hinge(random, degrees, deepest));
      const std::vector<Vec3> f = forces(hinge_mesh(degrees, 3), at),
                              g = forces(cut_hinge(degrees, 3, 5, 8), at);
      for (std::size_t i = 0; i < f.size(); i++) {
        const Real ratio = norm(f[i] - g[i]) / rounding(degrees, deepest);
        if (!(ratio <= largest)) largest = ratio;
      }
    }
  expect_at_most({kTheme, "5", "T-junctions along folds of -120 to 120 degrees: |dF| / rounding"},
                 largest, 1, "the same walls: roundings of overlaps and normals");
}

}    // namespace
}    // namespace lsdcd::test_nearly_flat
