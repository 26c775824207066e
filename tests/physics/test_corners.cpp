// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Corners, grooves, seams and rims against their closed forms.
#include "support/cover.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lsdcd::test_corners {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5;

Real radians(Real degrees)
{
  return degrees * kPi / 180;
}

// The wall's force on one sphere that is put here and there.
class Probe {
 public:
  explicit Probe(const TriangleSoup &soup, const EngineSettings &settings = hooke(kStiffness)) :
      scene_(soup, kRadius, settings, 0, 0)
  {
    scene_.add_sphere({1e3, 1e3, 1e3}, kRadius, 1);
  }
  Vec3 force(const Vec3 &x)
  {
    scene_.set_x(0, x);
    scene_.compute(1e-4, true, true);
    return scene_.force(0);
  }
  int contacts() const
  {
    return scene_.engine->results().n_touching() ? scene_.engine->results().touching()[0].n_contacts
                                                 : 0;
  }

 private:
  Scene scene_;
};

// Unit normals and distances carry a few roundings; the overlap is the radius less
// one of them, so that its error counts radius / overlap times.
Real tolerance(Real overlap)
{
  return 16 * kRoundoff * kRadius / overlap;
}

// ---- resting in grooves and corners -------------------------------------------------------

// A groove along y of half angle a about the z axis, its bottom at z = 0.
TriangleSoup groove(Real a)
{
  const Real s = 4 * std::sin(a), c = 4 * std::cos(a);
  TriangleSoup soup;
  soup.source = "groove";
  for (Real side : {-s, s})
    soup.corners.insert(
        soup.corners.end(),
        {{0, -4, 0}, {side, -4, c}, {side, 4, c}, {0, -4, 0}, {side, 4, c}, {0, 4, 0}});
  return soup;
}

TEST(groove, up_to_a_right_angle_bears_mg_over_2_sin_a_on_each_side)
{
  // mg = 1: each side is overlapped by N/k, and the two forces add up to the weight.
  for (Real degrees : {20., 30., 40., 44.9, 45.}) {
    const Real a = radians(degrees), weight = 50, n = weight / (2 * std::sin(a));
    Probe probe(groove(a));
    const Real overlap = n / kStiffness;
    const Vec3 f = probe.force({0, 0.1, (kRadius - overlap) / std::sin(a)});
    EXPECT_NEAR(f.z, weight, 4 * weight * tolerance(overlap)) << degrees;
    EXPECT_NEAR(f.x, 0, 4 * weight * tolerance(overlap));
    EXPECT_EQ(probe.contacts(), 2);
  }
}

TEST(groove, wider_than_a_right_angle_bears_the_weight_of_one_wall)
{
  // l = d / (1 + cover), so that F = 2 k l sin a. Were the cover the cosine n.n, F were k d / sin a: the
  // stiffness k against sinking, as on a flat wall. It is that to 1e-6.
  for (Real degrees : {45., 45.1, 60., 80., 89.9, 89.9999}) {
    const Real a = radians(degrees), sunk = 0.01;
    Probe probe(groove(a));
    const Vec3 f = probe.force({0, 0.1, kRadius / std::sin(a) - sunk});
    const Real cosine = -std::cos(2 * a);
    EXPECT_NEAR(f.z, kStiffness * sunk * (1 + cosine) / (1 + cover_of(cosine)),
                4 * kStiffness * sunk * tolerance(sunk))
        << degrees;
    EXPECT_NEAR(f.z, kStiffness * sunk, kLessCovered * kStiffness * sunk) << degrees;
  }
}

TEST(box_corner, bears_mg_over_root_3_on_each_side)
{
  Probe probe(box_mesh({0, 0, 0}, {4, 4, 4}));
  for (Real depth : {1e-4, 1e-2}) {
    const Real at = kRadius - depth;
    const Vec3 f = probe.force({at, at, at});
    for (int k = 0; k < 3; k++)
      EXPECT_NEAR(f[k], kStiffness * depth, kStiffness * depth * tolerance(depth));
    // Exactly the sum: the corner rule leaves right angles alone.
    Probe sum(box_mesh({0, 0, 0}, {4, 4, 4}), [] {
      EngineSettings s = hooke(kStiffness);
      s.corner = Corner::sum;
      return s;
    }());
    EXPECT_EQ(sum.force({at, at, at}), f);
    EXPECT_EQ(probe.contacts(), 3);
  }
}

TEST(box, that_holds_a_sphere_on_all_six_sides_pushes_nowhere)
{
  Probe probe(box_mesh({0, 0, 0}, {0.96, 0.96, 0.96}));
  EXPECT_LE(norm(probe.force({0.48, 0.48, 0.48})), kStiffness * 4 * kRoundoff);
  EXPECT_EQ(probe.contacts(), 6);
  // Off the middle it is six springs, two of them along the way.
  const Vec3 f = probe.force({0.49, 0.48, 0.48});
  EXPECT_NEAR(f.x, -kStiffness * 0.02, kStiffness * 0.02 * tolerance(0.01));
}

// ---- a hinge, both ways -------------------------------------------------------------------

// The corner rule for two contacts, and the distance to two half-planes, in long
// double and without the core.
using Wide = long double;
struct Force {
  Wide x, z;
};

Force hinge_force(Wide degrees, Wide x, Wide z)
{
  const Wide a = degrees * static_cast<Wide>(kPi) / 180, c = std::cos(a), s = std::sin(a);
  struct Contact {
    Wide overlap, nx, nz;
  };
  std::vector<Contact> contacts;
  const auto add = [&](Wide fx, Wide fz) {
    const Wide d = std::hypot(x - fx, z - fz);
    if (d < kRadius) contacts.push_back({kRadius - d, (x - fx) / d, (z - fz) / d});
  };
  const Wide along = x * c + z * s;    // on the right half
  if (x < 0) add(x, 0);
  if (along > 0) add(along * c, along * s);
  if (x >= 0 && along <= 0) add(0, 0);
  if (contacts.empty()) return {0, 0};
  if (contacts.size() == 1) {
    const Contact &p = contacts[0];
    return {kStiffness * p.overlap * p.nx, kStiffness * p.overlap * p.nz};
  }
  const Contact &p = contacts[0], &q = contacts[1];
  const Wide g = cover_of(c), alone = (1 - g) * (1 + g);
  Wide l0 = (p.overlap - g * q.overlap) / alone, l1 = (q.overlap - g * p.overlap) / alone;
  if (l0 < 0) l0 = 0, l1 = q.overlap;
  if (l1 < 0) l1 = 0, l0 = p.overlap;
  return {kStiffness * (l0 * p.nx + l1 * q.nx), kStiffness * (l0 * p.nz + l1 * q.nz)};
}

// Walks over the seam at a height and compares with the closed form everywhere.
void expect_hinge(Real degrees)
{
  Probe probe(hinge_mesh(degrees, 3));
  Random random(2);
  const Real a = std::fabs(radians(degrees));
  for (int i = 0; i < 2000; i++) {
    const Real z = kRadius - 0.5 * std::pow(10., uniform(random, -3, -0.7));
    const Real size = random() % 2 ? 0.4 : std::pow(10., uniform(random, -9, -1));
    const Real x = uniform(random, -size, size);
    const Vec3 f = probe.force({x, 0.2, z});
    const Force expected = hinge_force(degrees, x, z);
    const Real off = static_cast<Real>(std::hypot(f.x - expected.x, f.z - expected.z));
    const Real scale = kStiffness * kRadius;
    // Roundings of positions and normals; on a shallow seam the way that two
    // overlaps share a force hangs on their difference over the angle, which turns
    // the force by the rounding over the angle, and never by more than the angle.
    const Real turned = std::fmin(a, 64 * kRoundoff / a);
    ASSERT_LE(off, scale * (32 * kRoundoff + turned))
        << "angle " << degrees << " x " << x << " z " << z;
    ASSERT_EQ(f.y, 0);
  }
}

TEST(hinge, has_the_closed_form_at_every_angle_concave_and_convex)
{
  for (Real degrees : {1e-6, 1e-4, 1e-2, 1., 10., 30., 60., 90.}) {
    expect_hinge(degrees);
    expect_hinge(-degrees);
  }
}

TEST(convex_seam, never_lets_go_of_a_sphere_that_overlaps)
{
  Random random(3);
  for (Real degrees : {-1e-9, -1e-6, -1e-3, -1., -45., -135., -179.}) {
    Probe probe(hinge_mesh(degrees, 3));
    for (int i = 0; i < 2000; i++) {
      const Real x = std::pow(10., uniform(random, -17, -1.4)) * (random() % 2 ? 1 : -1),
                 depth = 0.01;
      // The closest point at x on one half or the other, or on the edge, seen along the bisector.
      const Vec3 f = probe.force({x, 0.2, kRadius - depth});
      ASSERT_GT(norm(f), 0) << degrees << " " << x;
      ASSERT_GE(probe.contacts(), 1);
    }
  }
}

// ---- thin bodies --------------------------------------------------------------------------

TEST(thin_plate, has_a_rim_that_pushes_along_the_nearest_way)
{
  const Real t = 1e-3 * kRadius, depth = 0.02;
  Probe probe(box_mesh({-2, -2, -t}, {2, 2, 0}));
  for (int degrees = -90; degrees <= 90; degrees += 3) {
    const Real a = radians(degrees);
    const Vec3 n = {std::cos(a), 0, std::sin(a)};
    const Vec3 p = {2, 0.1, degrees > 0 ? 0 : (degrees < 0 ? -t : -t / 2)};
    const Vec3 f = probe.force(p + (kRadius - depth) * n);
    // The other rim, t away, answers nowhere that this one is nearer.
    EXPECT_LE(norm(f - kStiffness * depth * n), kStiffness * depth * tolerance(depth)) << degrees;
  }
}

}    // namespace
}    // namespace lsdcd::test_corners
