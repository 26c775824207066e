// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Superellipsoids and the least signed distance of triangles from them, against closed forms and an oracle in long double
// that knows the shape by its two defining formulas alone.
//   LSDCD_SHAPE_PAIRS  pairs of shape and triangle, 2e4 unless given
#include "shape/are_apart.h"
#include "shape/least_mass.h"
#include "shape/superellipsoid.h"
#include "shape/triangle_minimum.h"
#include "support/random.h"
#include "support/shape_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace lsdcd::test_shape {
namespace {

Superellipsoid random_shape(Random &random, Real most_exponent)
{
  const auto exponent = [&] {
    constexpr Real kOften[] = {2, 2, 2.5, 3, 4, 6, 8, 20};
    return std::min(kOften[static_cast<int>(uniform(random, 0, 8))], most_exponent);
  };
  const Real n1 = exponent(), n2 = exponent();
  return make_superellipsoid(uniform(random, {1, 1, 1}, {5, 5, 5}), n1, n2);
}

struct Triangle {
  Vec3 corner[3];

  Vec3 normal() const { return unit(cross(corner[1] - corner[0], corner[2] - corner[0])); }
  // How far its plane is rounded to lie from its corners: a normal turns by rounding times length over height.
  Real rounding() const
  {
    Real longest = 0;
    for (int k = 0; k < 3; k++)
      longest = std::fmax(longest, norm(corner[k] - corner[k == 2 ? 0 : k + 1]));
    const Real twice_area = norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
    return 8 * kRoundoff * longest * (longest * longest / twice_area);
  }
  void move(const Vec3 &by)
  {
    for (Vec3 &c : corner) c += by;
  }
};

ShapeMinimum find(const Superellipsoid &s, const Triangle &t, Real below = HUGE_VAL)
{
  return TriangleMinimum(s, t.corner, t.normal()).find(below);
}

// A triangle of any size, also a needle, somewhere outside the shape.
Triangle random_triangle(Random &random, const Superellipsoid &s)
{
  const Real size = s.farthest * log_uniform(random, 0.02, 20),
             thin = uniform(random, 0, 1) < 0.2 ? log_uniform(random, 1e-3, 1) : 1;
  const Vec3 along = random_unit(random), across = unit(cross(along, random_unit(random))),
             out = random_unit(random);
  Triangle t;
  for (Vec3 &c : t.corner)
    c = uniform(random, -size, size) * along + (thin * uniform(random, -size, size)) * across;
  Real lowest = HUGE_VAL;
  for (const Vec3 &c : t.corner) lowest = std::fmin(lowest, dot(out, c));
  t.move((s.farthest - lowest) * out +
         uniform(random, 0, s.farthest) * unit(cross(out, random_unit(random))));
  return t;
}

double pairs(double otherwise)
{
  const char *text = std::getenv("LSDCD_SHAPE_PAIRS");
  return text ? std::atof(text) : otherwise;
}

// How wrong an answer is, by proofs in long double. Its normal gives a plane under the signed distance everywhere, which
// bounds that on the triangle from below by its corners. Its foot is on the triangle, so that the signed distance there, by
// the oracle, bounds it from above.
struct Wrong {
  Long below = 0;    // how much the answer may be above the minimum
  Long foot = 0;     // distance of the foot from the triangle
};
Wrong wrong_by(const ShapeOracle &oracle, const Triangle &t, const ShapeMinimum &m)
{
  const LongVec n = vec_cast<Long>(m.normal), unit_n = (1 / length(n)) * n;
  Long least = HUGE_VAL;
  for (const Vec3 &c : t.corner) least = std::min(least, dot(unit_n, vec_cast<Long>(c)));
  Wrong wrong;
  wrong.below = m.distance - (least - oracle.support(unit_n));
  // Past which side of the triangle, or off its plane.
  const LongVec normal = vec_cast<Long>(t.normal()), foot = vec_cast<Long>(m.foot);
  wrong.foot = std::fabs(dot(normal, foot - vec_cast<Long>(t.corner[0])));
  for (int k = 0; k < 3; k++) {
    const LongVec from = vec_cast<Long>(t.corner[k]),
                  side = vec_cast<Long>(t.corner[(k + 1) % 3]) - from;
    wrong.foot = std::max(wrong.foot, -dot(cross(normal, (1 / length(side)) * side), foot - from));
  }
  return wrong;
}

}    // namespace

TEST(shape, has_the_support_volume_and_inertia_of_the_closed_forms)
{
  struct Row {
    Vec3 half;
    Real n1, n2, height;
  };
  // (1, 1, 1)/sqrt(3), by mpmath.
  const Row rows[] = {{{1, 1, 1}, 8, 8, 1.509804},
                      {{1, 1, 1}, 4, 4, 1.316074},
                      {{1, 1, 1}, 8, 2, 1.280861},
                      {{3, 2, 1}, 2, 2, 2.160247},
                      {{3, 2, 1}, 4, 8, 2.911123}};
  for (const Row &r : rows) {
    const Superellipsoid s = make_superellipsoid(r.half, r.n1, r.n2);
    EXPECT_NEAR(support(s, unit({1, 1, 1})).height, r.height, 5e-7);
  }
  const Superellipsoid s = make_superellipsoid({3, 2, 1}, 4, 8);
  const Vec3 inertia = inertia_over_mass(s);
  EXPECT_NEAR(volume(s), 41.049289, 5e-7);
  EXPECT_NEAR(inertia.x, 1.452347, 5e-7);
  EXPECT_NEAR(inertia.y, 2.925070, 5e-7);
  EXPECT_NEAR(inertia.z, 3.829081, 5e-7);
}

// Dirichlet's integral of x^(p - 1) y^(q - 1) over |x|^n + |y|^n <= 1, x, y >= 0.
Long dirichlet(Long p, Long q, Long n)
{
  return std::tgamma(p / n) * std::tgamma(q / n) / std::tgamma(1 + (p + q) / n) / (n * n);
}

// A section at the height z is the one in the middle times s = (1 - |z/c|^n1)^(1/n1), its area s^2 and its moments of area s^4.
TEST(shape, has_the_volume_and_inertia_of_its_sections)
{
  Random random(23);
  for (int i = 0; i < 50; i++) {
    const Superellipsoid s = make_superellipsoid(uniform(random, {1, 1, 1}, {5, 5, 5}),
                                                 uniform(random, 2, 20), uniform(random, 2, 20));
    const Long a = s.half.x, b = s.half.y, c = s.half.z, n1 = s.n1, n2 = s.n2;
    // The integral of |z|^(p - 1) s^q over z is that of a Beta function.
    const auto along = [&](Long p, Long q) {
      return 2 * std::pow(c, p) * std::tgamma(p / n1) * std::tgamma(1 + q / n1) /
             std::tgamma(1 + (p + q) / n1) / n1;
    };
    const Long area = 4 * a * b * dirichlet(1, 1, n2), all = area * along(1, 2);
    const Long xx = 4 * a * a * a * b * dirichlet(3, 1, n2) * along(1, 4) / all,
               yy = 4 * a * b * b * b * dirichlet(1, 3, n2) * along(1, 4) / all,
               zz = area * along(3, 2) / all;
    EXPECT_NEAR(volume(s) / Real(all), 1, 1e-12);
    const Vec3 inertia = inertia_over_mass(s);
    EXPECT_NEAR(inertia.x / Real(yy + zz), 1, 1e-12);
    EXPECT_NEAR(inertia.y / Real(zz + xx), 1, 1e-12);
    EXPECT_NEAR(inertia.z / Real(xx + yy), 1, 1e-12);
  }
}

TEST(shape, touches_its_support_planes_at_points_of_its_surface)
{
  Random random(1);
  for (int i = 0; i < 60; i++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    for (int j = 0; j < 20; j++) {
      Vec3 n = random_unit(random);
      if (j < 3) n = unit(Vec3{j == 0 ? 0.0 : n.x, j == 1 ? 0.0 : n.y, j == 2 ? 0.0 : n.z});
      if (j >= 3 && j < 6) n = {j == 3 ? 1.0 : 0.0, j == 4 ? -1.0 : 0.0, j == 5 ? 1.0 : 0.0};
      const SupportPlane plane = support(s, n);
      // Powers of exponents to 20 multiply rounding by as much.
      EXPECT_NEAR(plane.height, double(oracle.support(vec_cast<Long>(n))), 1e-14 * s.farthest);
      EXPECT_NEAR(dot(n, plane.point), plane.height, 1e-14 * s.farthest);
      EXPECT_NEAR(double(oracle.gauge(vec_cast<Long>(plane.point))), 1, 1e-13);
      EXPECT_NEAR(gauge(s, plane.point).value, 1, 1e-13);
      EXPECT_NEAR(gauge_value(s, 3 * plane.point), 3, 1e-13);
      // Where a flat side faces n its point is anywhere on it by rounding, but not the normal there.
      const Vec3 back = gauge(s, plane.point).slope;
      EXPECT_LT(norm((1 / norm(back)) * back - n), 1e-12);
    }
  }
}

TEST(shape, lies_between_its_inscribed_and_circumscribed_spheres_and_reaches_both)
{
  Random random(2);
  for (int i = 0; i < 12; i++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    Real least = HUGE_VAL, most = 0;
    constexpr int kSteps = 300;
    for (int j = 0; j <= kSteps; j++)
      for (int k = 0; k <= kSteps; k++) {
        const Real r =
            norm(oracle.surface(Real(j * kQuarter / kSteps), Real(k * kQuarter / kSteps)));
        least = std::fmin(least, r), most = std::fmax(most, r);
      }
    EXPECT_NEAR(least, s.nearest, 1e-12 * s.farthest);    // the ends of axes are among the rays
    EXPECT_LE(most, s.farthest * (1 + 1e-14));
    EXPECT_NEAR(
        most, s.farthest,
        1e-3 * s.farthest);    // half the square of half a step, over a radius of curvature of 0.04
  }
}

TEST(shape, has_the_curvature_with_which_its_normals_turn)
{
  Random random(3);
  for (int i = 0; i < 100; i++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    const LongVec x = oracle.surface<Long>(uniform(random, 0.05, 1.5), uniform(random, 0.05, 1.5));
    const auto normal = [&](const LongVec &at) {
      constexpr Long kStep = 1e-5L;
      LongVec g;
      for (int k = 0; k < 3; k++) {
        LongVec up = at, down = at;
        up[k] += kStep, down[k] -= kStep;
        g[k] = (oracle.gauge(up) - oracle.gauge(down)) / (2 * kStep);
      }
      return (1 / length(g)) * g;
    };
    // The mean curvature is half the divergence of the normals; the square of all turns gives the product.
    constexpr Long kStep = 1e-5L;
    Long turn[3][3], divergence = 0, square = 0;
    for (int k = 0; k < 3; k++) {
      LongVec up = x, down = x;
      up[k] += kStep, down[k] -= kStep;
      const LongVec change = (1 / (2 * kStep)) * (normal(up) - normal(down));
      for (int l = 0; l < 3; l++) turn[k][l] = change[l];
      divergence += change[k];
    }
    for (int k = 0; k < 3; k++)
      for (int l = 0; l < 3; l++) square += turn[k][l] * turn[l][k];
    const Curvature c = curvature_at(s, vec_cast<Real>(x));
    const double scale = 1 / s.rho, mean = double(divergence / 2);
    const double product = double((divergence * divergence - square) / 2);
    EXPECT_NEAR(c.mean, mean,
                1e-5 * scale);    // differences of second order: (1e-5/rho)^2 and rounding
    EXPECT_NEAR(c.product, product, 1e-4 * scale * scale);
    EXPECT_LE(c.largest() * s.rho, 1 + 1e-9);
  }
  const Superellipsoid s = make_superellipsoid({3, 2, 1}, 2, 2);
  EXPECT_NEAR(curvature_at(s, {3, 0, 0}).mean, (3.0 / 4 + 3) / 2, 1e-14);
  EXPECT_NEAR(curvature_at(s, {0, 0, 1}).product, 1.0 / 9 * 1 / 4, 1e-14);
  EXPECT_EQ(curvature_at(make_superellipsoid({3, 2, 1}, 4, 8), {0, 0, 1}).largest(), 0);
}

TEST(shape, lets_a_ball_of_its_least_radius_of_curvature_roll_inside_and_no_larger_one)
{
  Random random(4);
  EXPECT_NEAR(make_superellipsoid({5, 1, 1}, 2, 2).rho, 0.2, 1e-15);
  EXPECT_NEAR(make_superellipsoid({5, 5, 1}, 2, 8).rho, 0.154, 5e-4);
  for (int i = 0; i < 10; i++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    bool larger_fits = true;
    for (int j = 0; j <= 60; j++)
      for (int k = 0; k <= 60; k++) {
        const Vec3 x = oracle.surface<Real>(j * kQuarter / 60, k * kQuarter / 60);
        const Vec3 n = unit(gauge(s, x).slope);
        EXPECT_GE(oracle.distance_from_cloud(x - s.rho * n), s.rho * (1 - 1e-9));
        larger_fits = larger_fits &&
                      oracle.distance_from_cloud(x - 1.2 * s.rho * n) >= 1.2 * s.rho * (1 - 1e-9);
      }
    EXPECT_FALSE(larger_fits);
  }
}

// Narrow ridges of curvature, askew to the angles of a search. Numbers: the first at 40 digits, by differences of the equation of
// the surface where it is most curved among 4e6 places; the others by the equation's derivatives among 9e6.
TEST(shape, has_its_least_radius_of_curvature_on_a_narrow_ridge)
{
  const struct {
    Vec3 half;
    Real n1, n2, rho;
  } rows[] = {
      {{0.4739965951038245, 0.12049333021757178, 0.04368235481377131}, 2.5, 12, 0.009879463817},
      {{0.161765, 0.746421, 0.144905}, 20, 20, 0.01087380432},
      {{0.591307, 0.110273, 0.0518426}, 2.001, 12, 0.00453891088}};
  for (const auto &row : rows)
    EXPECT_NEAR(make_superellipsoid(row.half, row.n1, row.n2).rho, row.rho, 2e-5 * row.rho);
}

// The longest arm of a normal of a spheroid is the difference of its half-axes a and c, and its inertia across the axis (a^2 + c^2)/5 m.
TEST(shape, meets_a_plane_with_the_least_mass_of_a_spheroid_in_closed_form)
{
  for (const auto &[a, c] : {std::array<Real, 2>{1, 1}, {1, 5}, {0.2, 1}, {1.5, 0.8}, {3, 0.1}}) {
    const Real arm = a - c, share = 1 / (1 + 5 * arm * arm / (a * a + c * c));
    EXPECT_NEAR(least_mass_share(make_superellipsoid({a, a, c}, 2, 2)), share, 1e-9);
    EXPECT_NEAR(least_mass_share(make_superellipsoid({c, a, a}, 2, 2)), share, 1e-9);
  }
}

// Normals of a lattice of directions do not have the very least: between two of them, a step of 1/80 of a quarter turn apart, an arm
// that turns with its normal changes by half of the square of that at most, times the ratio of the half-axes, here up to 5.
TEST(shape, meets_a_plane_with_no_less_mass_than_at_any_of_its_normals)
{
  constexpr int kSteps = 80;
  const Real step = kPi / 2 / kSteps;
  Random random(91);
  for (int k = 0; k < 40; k++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    const LongVec inertia = vec_cast<Long>(inertia_over_mass(s));
    Long least = 1;
    for (int i = 0; i <= kSteps; i++)
      for (int j = 0; j <= kSteps; j++) {
        const Vec3 n = {std::cos(i * step) * std::cos(j * step),
                        std::cos(i * step) * std::sin(j * step), std::sin(i * step)};
        const LongVec arm = cross(oracle.point(vec_cast<Long>(n)), vec_cast<Long>(n));
        least = std::min(least, 1 / (1 + arm.x * arm.x / inertia.x + arm.y * arm.y / inertia.y +
                                     arm.z * arm.z / inertia.z));
      }
    const Real found = least_mass_share(s);
    EXPECT_LE(found, least * (1 + 1e-9)) << k;
    EXPECT_GE(found, least * (1 - 5 * step * step)) << k;
  }
}

TEST(shape, finds_the_point_of_its_surface_from_which_a_point_was_made)
{
  Random random(5);
  for (int i = 0; i < 100; i++) {
    const Superellipsoid s = random_shape(random, 20);
    const ShapeOracle oracle(s);
    for (int j = 0; j < 200; j++) {
      Vec3 x = oracle.surface<Real>(uniform(random, 0, kQuarter), uniform(random, 0, kQuarter));
      for (int k = 0; k < 3; k++)
        if (uniform(random, 0, 1) < 0.5) x[k] = -x[k];
      const Vec3 n = unit(gauge(s, x).slope);
      const Real depth =
          j % 2 == 0 ? uniform(random, 0, 0.95) * s.rho : -log_uniform(random, 1e-6, 100);
      const SurfacePoint p = nearest_on_surface(s, x - depth * n);
      EXPECT_TRUE(p.is_sure);
      // Rounding of the point is 1e-16 of its place, and that of a normal turns it by depth/(1 - depth/rho).
      EXPECT_NEAR(p.distance, -depth, 1e-14 * (s.farthest + std::fabs(depth)));
      EXPECT_LT(norm(p.normal - n), 1e-12);
    }
  }
}

// One shape at the other one's plane with a normal n, so far from it: that is their distance, or how far one is in the other one, as
// long as that is less than their radii of curvature.
TEST(shape, is_apart_from_another_one_by_their_distance_along_a_common_normal)
{
  Random random(11);
  constexpr int kN = 100;
  int missed = 0;
  for (int i = 0; i < kN; i++) {
    const Superellipsoid shapes[2] = {random_shape(random, 20), random_shape(random, 20)};
    const Vec3 n = random_unit(random);
    PlacedGrain grains[2];
    Vec3 point[2];
    for (int k = 0; k < 2; k++) {
      grains[k] = place_grain(shapes[k], {0, 0, 0},
                              rotation_about(random_unit(random), uniform(random, 0, 3)));
      const Vec3 own = grains[k].to_own(k == 0 ? n : -n);
      const LongVec x = ShapeOracle(shapes[k]).point(vec_cast<Long>(own));
      point[k] = grains[k].turned({Real(x.x), Real(x.y), Real(x.z)});
    }
    const auto are_apart_by = [&](Real distance) {
      grains[1].centre = point[0] + distance * n - point[1];
      return are_apart(grains[0], grains[1]);
    };
    // 1e-9 is above the rounding of points of 5 that are turned, and below the least radius of curvature, 1e-4.
    for (const Real in : {1e-9, 1e-6}) EXPECT_FALSE(are_apart_by(-in)) << i;
    for (const Real out : {1e-6, 1e-3}) missed += !are_apart_by(out);
    EXPECT_TRUE(are_apart_by(2 * (shapes[0].farthest + shapes[1].farthest)));
  }
  EXPECT_LE(missed, 2);    // one in a thousand: in 200, 3 in one run of 900
}

TEST(shape, is_found_by_random_triangles_as_deep_as_the_oracle_says)
{
  Random random(6);
  const int n_each = 1000, n_shapes = static_cast<int>(pairs(2e4) / n_each);
  long touching = 0, missed = 0, wrong = 0, unsure = 0, parts[3] = {0, 0, 0};
  Long worst_below = 0, worst_foot = 0, worst_above = 0;
  for (int i = 0; i < n_shapes; i++) {
    const Superellipsoid s = random_shape(random, i % 10 == 0 ? 20 : 8);
    const ShapeOracle oracle(s);
    const Long size = s.farthest;
    for (int j = 0; j < n_each; j++) {
      Triangle t = random_triangle(random, s);
      // Moved along the normal it keeps its foot, down to an overlap of rho/2, which the oracle confirms.
      const ShapeMinimum first = find(s, t);
      t.move((-uniform(random, -0.1, 0.5) * s.rho - first.distance) * first.normal);
      const ShapeMinimum m = find(s, t);
      const Wrong by = wrong_by(oracle, t, m);
      unsure += !m.is_sure || !m.is_smooth;
      parts[static_cast<int>(m.part)]++;
      worst_below = std::max(worst_below, by.below / size);
      worst_foot = std::max(worst_foot, by.foot / size);
      wrong += !(by.below <= 1e-12L * size && by.foot <= 1e-12L * size + t.rounding());
      // The oracle's distance of the foot is that of the answer. The cloud is on all, downhill from it on some.
      const bool refine = j % 100 == 0;
      const Long distance =
          refine ? oracle.distance(m.foot) : Long(oracle.distance_from_cloud(m.foot));
      const Long above = std::fabs(Long(m.distance)) - distance;
      if (refine) worst_above = std::max(worst_above, std::fabs(above) / size);
      wrong += !(above <= 1e-10L * size) || (refine && !(above >= -1e-10L * size));
      const ShapeMinimum contact = find(s, t, 0);
      touching += m.distance < 0;
      missed += (m.distance < 0) != (contact.distance < 0) ||
                (m.distance < 0 && contact.distance != m.distance);
    }
  }
  std::printf("%ld touching, %ld on faces, %ld on edges, %ld on corners; worst %.1Le below, %.1Le "
              "above, foot %.1Le\n",
              touching, parts[0], parts[1], parts[2], worst_below, worst_above, worst_foot);
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(unsure, 0);
  EXPECT_GT(touching, n_shapes * n_each / 2);
}

TEST(shape, lies_in_triangles_through_its_middle_no_deeper_anywhere_around_the_foot)
{
  Random random(7);
  int parts[3] = {0, 0, 0};
  for (int i = 0, n = static_cast<int>(pairs(2e4) / 1000); i < n; i++) {
    const Superellipsoid s = random_shape(random, 8);
    const ShapeOracle oracle(s);
    Triangle t = random_triangle(random, s);
    const Vec3 middle = (1.0 / 3) * (t.corner[0] + t.corner[1] + t.corner[2]);
    t.move(uniform(random, 0, 0.5) * s.nearest * random_unit(random) - middle);
    const ShapeMinimum m = find(s, t);
    EXPECT_TRUE(m.is_sure);
    parts[static_cast<int>(m.part)]++;
    EXPECT_LE(wrong_by(oracle, t, m).foot, 1e-12 * s.farthest + t.rounding());
    // The oracle goes downhill to half the digits of the place, all of the distance.
    EXPECT_NEAR(oracle.signed_distance(m.foot), m.distance, 1e-11 * s.farthest);
    // Convex: what is no less anywhere near is the least of all.
    for (int k = 0; k < 12; k++) {
      const Vec3 to =
          t.corner[k % 3] + uniform(random, 0, 1) * (t.corner[(k + 1) % 3] - t.corner[k % 3]);
      const Vec3 y = m.foot + std::fmin(1, 0.01 * s.nearest / norm(to - m.foot)) * (to - m.foot);
      EXPECT_GE(oracle.signed_distance(y), m.distance - 1e-11 * s.farthest);
    }
  }
  EXPECT_GT(std::min({parts[0], parts[1], parts[2]}), 0);
}

TEST(shape, has_two_nearest_points_where_a_point_is_in_the_middle_of_an_ellipsoid_and_takes_one)
{
  Random random(9);
  for (int i = 0; i < 20; i++) {
    Vec3 half = uniform(random, {2, 2, 2}, {5, 5, 5});
    half[i % 3] = 1;
    const Superellipsoid s = make_superellipsoid(half, 2, 2);
    Vec3 y = uniform(random, -0.3 * half, 0.3 * half);
    y[i % 3] = 0;
    const SurfacePoint p = nearest_on_surface(s, y);
    EXPECT_NEAR(p.distance, ShapeOracle(s).signed_distance(y), 1e-11);
    EXPECT_NEAR(gauge_value(s, p.point), 1, 1e-14);
    EXPECT_LT(norm(p.point + p.distance * p.normal - y), 1e-13);
  }
}

TEST(shape, touches_a_line_under_a_flat_side_over_its_foot)
{
  Random random(10);
  for (int i = 0; i < 200; i++) {
    const Superellipsoid s =
        make_superellipsoid(uniform(random, {1, 1, 1}, {5, 5, 5}), 8, i % 2 ? 8 : 20);
    // Nearly in the middle of the sides along y, where the normal does not tell how nearly.
    Vec3 x = {s.half.x * uniform(random, 0.2, 1), s.half.y * uniform(random, 0.001, 0.02),
              s.half.z * uniform(random, 0.2, 1)};
    x = (1 / gauge_value(s, x)) * x;
    const Vec3 n = unit(gauge(s, x).slope), along = unit(cross(n, random_unit(random)));
    const Vec3 foot = x - 0.3 * s.rho * n;
    const TangentMinimum line =
        TangentAboutLine(s, foot + uniform(random, -3, 3) * along, along).find();
    EXPECT_NEAR(line.distance, -0.3 * s.rho, 1e-13 * s.farthest);
    EXPECT_NEAR(nearest_on_surface(s, line.foot).distance, line.distance, 1e-13 * s.farthest);
  }
}

TEST(shape, lies_in_a_triangle_deepest_inside_where_a_side_has_two_gradients)
{
  // The triangle is cut by a mirror plane of the shape, on which two points of the surface are equally near.
  const Superellipsoid s =
      make_superellipsoid({3.9907397022581281, 1.0988750040755435, 2.7419745273068701}, 3, 2);
  const Triangle t = {{{-0.21344611173217753, -2.423755849790624, -0.48784587732720208},
                       {0.014962583691412235, -0.27320371564405477, 2.5048645195478398},
                       {0.71415911873487481, 1.3104450192844785, -1.3215293238608457}}};
  const Vec3 inside = {0.38768708628525678, 7.4113376238344231e-05, -1.0180167533257831};
  EXPECT_LE(find(s, t).distance, ShapeOracle(s).signed_distance(inside) + 1e-11);
}

TEST(shape, touches_faces_edges_and_corners_along_its_axes_at_the_ends_of_these)
{
  for (Real n1 : {2.0, 8.0, 20.0})
    for (Real n2 : {2.0, 8.0, 20.0}) {
      const Superellipsoid s = make_superellipsoid({3, 2, 1}, n1, n2);
      const Real depth = 0.4 * s.rho;
      for (int axis = 0; axis < 3; axis++)
        for (Real sign : {-1.0, 1.0}) {
          Vec3 n = {0, 0, 0}, one = {0, 0, 0}, two = {0, 0, 0};
          n[axis] = sign, one[(axis + 1) % 3] = 1, two[(axis + 2) % 3] = 1;
          const Vec3 end = (s.half[axis] - depth) * n;
          const Vec3 apex = end + 9 * n;
          const Triangle triangles[] = {
              {{end - 9 * one - 9 * two, end + 9 * one - 9 * two, end + 9 * two}},
              {{end - 9 * one, end + 9 * one, apex}},
              {{end - 9 * two, end + 9 * two, apex}},
              {{end - 9 * (one + two), end + 9 * (one + two), apex}},
              {{end, apex + one, apex + two}}};
          for (int k = 0; k < 5; k++) {
            const ShapeMinimum m = find(s, triangles[k], 0);
            EXPECT_EQ(m.part, k == 0  ? TrianglePart::face
                              : k < 4 ? TrianglePart::edge
                                      : TrianglePart::corner);
            EXPECT_NEAR(m.distance, -depth, 1e-14);
            EXPECT_LT(norm(m.normal - n), 1e-13);
            EXPECT_TRUE(m.is_smooth);
            // On a flat side the foot may be where the side is flat to rounding.
            EXPECT_NEAR(dot(n, m.foot), dot(n, end), 1e-14);
          }
        }
    }
}

TEST(shape, has_the_same_minimum_at_any_scale_to_the_bit)
{
  Random random(8);
  for (int i = 0; i < 30; i++) {
    const Superellipsoid s = random_shape(random, 20);
    Triangle t = random_triangle(random, s);
    const ShapeMinimum first = find(s, t);
    t.move((-0.3 * s.rho - first.distance) * first.normal);
    const ShapeMinimum m = find(s, t);
    for (Real scale : {std::ldexp(1.0, -200), std::ldexp(1.0, 200)}) {
      const Superellipsoid scaled = make_superellipsoid(scale * s.half, s.n1, s.n2);
      const Triangle other = {{scale * t.corner[0], scale * t.corner[1], scale * t.corner[2]}};
      const ShapeMinimum there = TriangleMinimum(scaled, other.corner, t.normal()).find(0);
      EXPECT_EQ(there.distance, scale * m.distance);
      EXPECT_EQ(there.normal, m.normal);
      EXPECT_EQ(there.foot, scale * m.foot);
    }
  }
}

}    // namespace lsdcd::test_shape
