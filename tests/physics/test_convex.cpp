// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Convex edges, corners and cone tips are one contact, whatever meets there and in
// whatever order.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lsdcd::test_convex {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2;
constexpr const char *kTheme = "Convex edges, corners and tips";

// A fan of n facets around a tip at the origin. Its edges fall by `height` over a
// radius of 2; uneven ones by up to twice that, at angles unevenly spread: a star
// with ridges and grooves.
TriangleSoup fan(int n, Real height, bool even, Random &random)
{
  std::vector<Vec3> rim;
  for (int i = 0; i < n; i++) {
    const Real a = 2 * kPi * (i + (even ? 0 : uniform(random, -0.45, 0.45))) / n;
    const Real r = even ? 2 : uniform(random, 1, 2), steeper = even ? 1 : uniform(random, 1, 2);
    rim.push_back({r * std::cos(a), r * std::sin(a), -height * steeper * r / 2});
  }
  TriangleSoup soup;
  soup.source = "fan";
  for (int i = 0; i < n; i++)
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, rim[i], rim[(i + 1) % n]});
  return soup;
}

// Facets in random order, each starting at any corner and wound either way.
TriangleSoup shuffled(const TriangleSoup &soup, Random &random)
{
  std::vector<std::size_t> order(soup.n_triangles());
  for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  TriangleSoup out;
  out.source = soup.source;
  for (std::size_t t : order) {
    const std::size_t k = random() % 3, step = 1 + random() % 2;
    for (std::size_t c = 0; c < 3; c++)
      out.corners.push_back(soup.corners[3 * t + (k + c * step) % 3]);
  }
  return out;
}

// The overlap is the radius less a distance of a few roundings. F0 is the force at an overlap of kDepth.
constexpr Real kDepth = 0.02 * kRadius, kExact = 16 * kRoundoff * kRadius / kDepth;

struct Answer {
  Real off = 0;    // the largest |F - k d n| / F0
  int most = 0;    // contacts
};

// Spheres that overlap points of a body by 1e-4 to 0.3 radii.
class Overlapping {
 public:
  Overlapping(const TriangleSoup &soup, Random &random) :
      random_(random), scene_(soup, kRadius, hooke(kStiffness), 0, 0)
  {
  }
  void add(const Vec3 &point, const Vec3 &normal)
  {
    const Real depth = kRadius * log_uniform(random_, 1e-4, 0.3);
    scene_.add_sphere(point + (kRadius - depth) * normal, kRadius, kMass);
    wanted_.push_back(kStiffness * depth * normal);
  }
  void compute(Answer &worst)
  {
    scene_.compute(1e-4, true, true);
    EXPECT_EQ(scene_.engine->results().n_touching(), scene_.n());
    for (int i = 0; i < scene_.engine->results().n_touching(); i++) {
      const Real now = norm(scene_.force(i) - wanted_[i]) / (kStiffness * kDepth);
      if (!(now <= worst.off)) worst.off = now;
      worst.most = std::max(worst.most, scene_.engine->results().touching()[i].n_contacts);
      EXPECT_GE(scene_.engine->results().touching()[i].n_contacts, 1);
    }
  }

 private:
  Random &random_;
  Scene scene_;
  std::vector<Vec3> wanted_;
};

void expect_exact(const char *id, const std::string &what, const Answer &a)
{
  expect_at_most({kTheme, id, what + ": |F - k d n|/F0"}, a.off, kExact, "roundings: 16 eps R / d");
  expect_answer({kTheme, id, what + ": most contacts"}, 1, a.most, 0, "one local minimum");
}

TEST(tip, of_any_fan_in_any_order_is_one_contact)
{
  Random random(1);
  for (int n : {3, 5, 50, 200, 2000})
    for (bool even : {true, false}) {
      Answer worst;
      for (Real height : {0.05, 1., 20.}) {
        Overlapping spheres(shuffled(fan(n, height, even, random), random), random);
        // Normals that lean from the axis by less than the flattest edge falls.
        const Real least = std::atan2(height, 2);
        spheres.add({0, 0, 0}, {0, 0, 1});
        for (int i = 0; i < 200; i++) {
          const Real lean = least * uniform(random, 0, 0.99), b = uniform(random, 0, 2 * kPi);
          spheres.add({0, 0, 0},
                      {std::sin(lean) * std::cos(b), std::sin(lean) * std::sin(b), std::cos(lean)});
        }
        spheres.compute(worst);
      }
      expect_exact("1", (even ? "even fan of " : "uneven fan of ") + std::to_string(n) + " facets",
                   worst);
    }
}

TEST(corner_of_a_body, is_one_contact_in_any_order)
{
  Random random(2);
  Answer worst;
  for (int k = 0; k < 10; k++) {
    Overlapping spheres(shuffled(box_mesh({0, 0, 0}, {1, 1, 1}), random), random);
    for (int i = 0; i < 200; i++)
      spheres.add({1, 1, 1}, unit({uniform(random, 0.01, 1), uniform(random, 0.01, 1),
                                   uniform(random, 0.01, 1)}));
    spheres.compute(worst);
  }
  expect_exact("2", "a box's corner, facets shuffled and turned", worst);
}

TEST(edge_of_a_body, is_one_contact_however_it_is_cut)
{
  // The ridge of a roof: its two sides in n and m strips, so that the ridge is cut by
  // vertices of one side or of both.
  Random random(3);
  for (int n : {1, 4, 6})
    for (int m : {1, 4, 9}) {
      TriangleSoup soup;
      soup.source = "roof";
      const auto side = [&](Real x, int strips) {
        for (int i = 0; i < strips; i++) {
          const Real y0 = -3 + 6. * i / strips, y1 = -3 + 6. * (i + 1) / strips;
          soup.corners.insert(soup.corners.end(), {{0, y0, 0}, {0, y1, 0}, {x, y1, -2}});
          soup.corners.insert(soup.corners.end(), {{0, y0, 0}, {x, y1, -2}, {x, y0, -2}});
        }
      };
      side(-3, n);
      side(2, m);
      Overlapping spheres(shuffled(soup, random), random);
      // Over vertices of either side, and beside them.
      for (int i = 0; i < 2000; i++) {
        const int cuts = i % 2 ? n : m;
        Real y = -3 + 6. * (random() % (cuts + 1)) / cuts;
        if (i % 3) y += std::pow(10., uniform(random, -15, 0)) * (random() % 2 ? 1 : -1);
        if (std::fabs(y) > 2.9) y = 0.1;
        const Real a = uniform(random, -std::atan2(2, 3), std::atan2(2, 2)) * 0.999;
        spheres.add({0, y, 0}, {std::sin(a), 0, std::cos(a)});
      }
      Answer worst;
      spheres.compute(worst);
      const std::string what =
          "a ridge cut into " + std::to_string(n) + " and " + std::to_string(m);
      expect_at_most({kTheme, "3", what + ": |F - k d n|/F0"}, worst.off, kExact,
                     "roundings: 16 eps R / d");
      EXPECT_EQ(worst.most, 1) << what;
    }
}

// Drops a sphere beside an edge or a corner at `aside` from it, until it has left.
Vec3 drop(const TriangleSoup &soup, const Vec3 &over, Real aside, const Vec3 &towards)
{
  const Real dt = kPi * std::sqrt(kMass / kStiffness) / 4000, speed = 0.2;
  Scene scene(soup, kRadius, hooke(kStiffness), 0, 0);
  const Real h = std::sqrt(kRadius * kRadius - aside * aside);
  scene.add_sphere(over + aside * towards + Vec3{0, 0, h + 1e-6}, kRadius, kMass, {0, 0, -speed});
  scene.compute(dt);
  bool touched = false;
  for (int i = 0; i < 20000; i++) {
    scene.step(dt, {0, 0, 0});
    const bool touches = norm_sq(scene.force(0)) > 0;
    if (touched && !touches) break;
    touched = touched || touches;
  }
  EXPECT_TRUE(touched);
  return (1 / speed) * scene.v(0);
}

TEST(drop, beside_an_edge_or_a_corner_leaves_in_the_mirrored_direction)
{
  // A stiff frictionless bounce mirrors the speed at the normal n = (centre - edge)/R
  // that it comes in along. While it lasts the normal turns: by the speed across,
  // v aside/R, times the contact time over R, and the speed leaves by twice that.
  const Real turn = 0.2 * kPi * std::sqrt(kMass / kStiffness) / kRadius;
  const TriangleSoup soup = box_mesh({-2, -2, -2}, {0, 0, 0});
  for (Real share : {0., 0.1, 0.3, 0.5, 0.7, 0.9})
    for (bool corner : {false, true}) {
      const Vec3 over = corner ? Vec3{0, 0, 0} : Vec3{0, -1, 0};
      const Vec3 towards = corner ? unit({1, 1, 0}) : Vec3{1, 0, 0};
      const Vec3 v = drop(soup, over, share * kRadius, towards);
      const Real up = 1 - share * share;    // n.z squared
      const Vec3 mirrored =
          Vec3{0, 0, -1} + 2 * std::sqrt(up) * (share * towards + std::sqrt(up) * Vec3{0, 0, 1});
      char what[100];
      std::snprintf(what, sizeof what, "a drop %g R beside %s: |v/v0 - mirrored|", share,
                    corner ? "a corner" : "an edge");
      expect_at_most({kTheme, "4", what}, norm(v - mirrored), 2 * turn * share + 1e-3,
                     "the normal turns by v t / R while it bounces; 4000 steps a bounce");
      // It leaves away from the body, or straight up from its top, never into it.
      EXPECT_GE(dot(v, towards), -1e-12);
      EXPECT_LE(std::fabs(dot(v, cross(towards, Vec3{0, 0, 1}))), 1e-12);
    }
}

}    // namespace
}    // namespace lsdcd::test_convex
