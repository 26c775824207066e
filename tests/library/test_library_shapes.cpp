// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Ellipsoids and superellipsoids through the library: beside its spheres, and what is refused.
#include "points_and_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace test_library_shapes {
namespace {

constexpr double kCutoff = 0.4;

class Shape : public ::testing::Test {
 protected:
  const lsdcd::Mesh mesh{::numbers(box_and_cylinder())};
  const lsdcd::Grid grid{mesh, kCutoff};
  std::mt19937 random{3};

  double uniform(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  }
  std::vector<double> numbers(std::size_t n, double lo, double hi)
  {
    std::vector<double> out(n);
    for (double &x : out) x = uniform(lo, hi);
    return out;
  }
  lsdcd::Shapes grains(std::size_t n)
  {
    lsdcd::Shapes g;
    g.centres = numbers(3 * n, -1, 1);
    g.half_axes = numbers(3 * n, 0.1, 0.25);
    g.exponents = numbers(2 * n, 2, 8);
    g.quaternions = numbers(4 * n, -1, 1);
    return g;
  }
};

TEST_F(Shape, of_a_sphere_has_the_contacts_and_distances_of_the_sphere)
{
  constexpr std::size_t kSpheres = 500;
  lsdcd::Shapes balls;
  balls.centres = numbers(3 * kSpheres, -1, 1);
  balls.quaternions = numbers(4 * kSpheres, -1, 1);
  const std::vector<double> radii = numbers(kSpheres, 0.02, kCutoff);
  for (double r : radii) balls.half_axes.insert(balls.half_axes.end(), {r, r, r});
  const lsdcd::Contacts<double> spheres = grid.contacts(balls.centres, radii);
  const lsdcd::ShapeContacts shapes = grid.shape_contacts(balls);
  EXPECT_EQ(shapes.first, spheres.first);
  ASSERT_EQ(shapes.overlap.size(), spheres.overlap.size());
  EXPECT_GT(shapes.overlap.size(), kSpheres / 2);
  EXPECT_EQ(shapes.feature, spheres.feature);
  EXPECT_EQ(shapes.triangle, spheres.triangle);
  for (std::size_t k = 0; k < shapes.overlap.size(); k++) {
    EXPECT_NEAR(shapes.overlap[k], spheres.overlap[k], 1e-14);
    for (std::size_t a = 3 * k; a < 3 * k + 3; a++) {
      EXPECT_NEAR(shapes.point[a], spheres.point[a], 1e-14);
      // Rounding over the distance, which is at least 1e-4 of these.
      EXPECT_NEAR(shapes.normal[a], spheres.normal[a], 1e-11);
      EXPECT_NEAR(shapes.of_grain[a], shapes.point[a] + -shapes.overlap[k] * shapes.normal[a],
                  1e-14);
    }
  }
  const lsdcd::ShapeDistances d = grid.shape_distances(balls);
  const std::vector<double> of_centre = lsdcd::Grid(mesh).distances(balls.centres);
  for (std::size_t i = 0; i < kSpheres; i++)
    EXPECT_NEAR(d.distance[i], of_centre[i] - radii[i], 1e-14);
}

TEST_F(Shape,
       has_its_deepest_contact_at_its_distance_with_any_number_of_threads_and_in_one_call_or_many)
{
  constexpr std::size_t kGrains = 70;    // more than threads take at a time
  const lsdcd::Shapes g = grains(kGrains);
  const lsdcd::ShapeContacts one = grid.shape_contacts(g, 1), four = grid.shape_contacts(g, 4);
  const lsdcd::ShapeDistances d = grid.shape_distances(g, 4);
  EXPECT_EQ(one.first, four.first);
  EXPECT_EQ(one.point, four.point);
  EXPECT_EQ(one.normal, four.normal);
  EXPECT_EQ(one.overlap, four.overlap);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < kGrains; i++) {
    const lsdcd::ShapeFacts facts =
        lsdcd::shape_facts({g.half_axes[3 * i], g.half_axes[3 * i + 1], g.half_axes[3 * i + 2]},
                           {g.exponents[2 * i], g.exponents[2 * i + 1]});
    double deepest = 0;
    for (std::size_t k = one.first[i]; k < one.first[i + 1]; k++)
      deepest = std::max(deepest, one.overlap[k]);
    // A face is touched along its own normal at any depth; beyond the least radius of curvature another way out is shorter.
    EXPECT_GE(deepest, -d.distance[i] - 1e-12);
    if (deepest < facts.curvature_radius) {
      EXPECT_NEAR(deepest, std::max(0.0, -d.distance[i]), 1e-12);
      compared += deepest > 0;
    }
    lsdcd::Shapes alone;
    alone.centres.assign(&g.centres[3 * i], &g.centres[3 * i] + 3);
    alone.half_axes.assign(&g.half_axes[3 * i], &g.half_axes[3 * i] + 3);
    alone.exponents.assign(&g.exponents[2 * i], &g.exponents[2 * i] + 2);
    alone.quaternions.assign(&g.quaternions[4 * i], &g.quaternions[4 * i] + 4);
    const lsdcd::ShapeContacts a = grid.shape_contacts(alone);
    ASSERT_EQ(a.overlap.size(), one.first[i + 1] - one.first[i]);
    for (std::size_t k = 0; k < a.overlap.size(); k++)
      EXPECT_EQ(a.overlap[k], one.overlap[one.first[i] + k]);
  }
  EXPECT_GT(compared, 5u);
}

// At any depth: past the least radius of curvature, too, where features may pass a contact on.
class ShapeAtTwoBodies : public Shape {
 protected:
  void expect_the_contacts_of_each(const lsdcd::TriangleSoup &left,
                                   const lsdcd::TriangleSoup &right)
  {
    lsdcd::TriangleSoup both = left;
    lsdcd::append(both, right);
    lsdcd::Shapes g = grains(kGrains);
    for (double &x : g.centres) x *= 0.3;
    Overlaps each(kGrains), together(kGrains);
    add_overlaps(g, left, each);
    add_overlaps(g, right, each);
    add_overlaps(g, both, together);
    std::size_t at_both = 0;
    for (std::size_t i = 0; i < kGrains; i++) {
      std::sort(each[i].begin(), each[i].end());
      std::sort(together[i].begin(), together[i].end());
      ASSERT_EQ(together[i].size(), each[i].size()) << i;
      for (std::size_t k = 0; k < each[i].size(); k++)
        EXPECT_NEAR(together[i][k], each[i][k], 1e-13);
      at_both += each[i].size() > 1;
    }
    EXPECT_GT(at_both, kGrains / 10);
  }

 private:
  static constexpr std::size_t kGrains = 300;
  using Overlaps = std::vector<std::vector<double>>;    // of each grain

  static void add_overlaps(const lsdcd::Shapes &g, const lsdcd::TriangleSoup &soup, Overlaps &of)
  {
    const lsdcd::Mesh alone{::numbers(soup)};
    const lsdcd::ShapeContacts found = lsdcd::Grid(alone, kCutoff).shape_contacts(g);
    for (std::size_t i = 0; i < kGrains; i++)
      of[i].insert(of[i].end(), &found.overlap[0] + found.first[i],
                   &found.overlap[0] + found.first[i + 1]);
  }
};

TEST_F(ShapeAtTwoBodies, that_are_apart_touches_them_as_it_touches_each)
{
  const auto cylinder_at = [](double x) {
    lsdcd::TriangleSoup soup = lsdcd::cylinder_mesh(24, 5, 0.5, 0.6);
    for (lsdcd::Vec3 &c : soup.corners) c.x += x;
    return soup;
  };
  expect_the_contacts_of_each(cylinder_at(-0.55), cylinder_at(0.55));
}

// Their triangles share a vertex, but not in a grain.
TEST_F(ShapeAtTwoBodies, that_meet_at_a_tip_far_away_touches_them_as_it_touches_each)
{
  const auto cone_at = [](double x) {
    constexpr int kSides = 24;
    lsdcd::TriangleSoup soup;
    soup.source = "cone";
    const auto rim = [&](int k) {
      const double angle = 2 * lsdcd::kPi * k / kSides;
      return lsdcd::Vec3{2 * x + std::cos(angle), std::sin(angle), 4};
    };
    for (int k = 0; k < kSides; k++)
      soup.corners.insert(soup.corners.end(), {{0, 0, -4}, rim(k), rim(k + 1)});
    return soup;
  };
  expect_the_contacts_of_each(cone_at(-0.55), cone_at(0.55));
}

TEST_F(Shape, has_the_facts_of_closed_forms)
{
  const lsdcd::ShapeFacts f = lsdcd::shape_facts({3, 2, 1}, {4, 8}),
                          ellipsoid = lsdcd::shape_facts({5, 1, 1});
  EXPECT_NEAR(f.volume, 41.049289, 5e-7);
  EXPECT_NEAR(f.inertia[0], 1.452347, 5e-7);
  EXPECT_NEAR(f.inertia[2], 3.829081, 5e-7);
  EXPECT_DOUBLE_EQ(ellipsoid.volume, 4 * lsdcd::kPi / 3 * 5);
  EXPECT_DOUBLE_EQ(ellipsoid.inertia[1], 26.0 / 5);
  EXPECT_DOUBLE_EQ(ellipsoid.circumscribed, 5);
  EXPECT_DOUBLE_EQ(ellipsoid.inscribed, 1);
  EXPECT_DOUBLE_EQ(ellipsoid.curvature_radius, 0.2);
  // The longest arm of its normals is the difference of its half-axes.
  EXPECT_NEAR(ellipsoid.least_mass, 1 / (1 + 16 / (26.0 / 5)), 1e-9);
}

TEST_F(Shape, is_refused_by_a_sentence_where_it_makes_none)
{
  const auto refused = [&](const lsdcd_grid *by, lsdcd_shapes s, int code, const char *says) {
    s.size = sizeof s;
    EXPECT_EQ(lsdcd_shapes_host(by, &s), code);
    EXPECT_NE(std::strstr(lsdcd_last_error(), says), nullptr) << lsdcd_last_error();
  };
  const double centres[] = {0, 0, 0, 0, 0, 0}, half[] = {1, 1, 1, 1, 1, -1},
               exponents[] = {2, 2, 30, 2}, turns[] = {1, 0, 0, 0, 0, 0, 0, 0};
  std::size_t first[3];
  lsdcd_shapes s = {};
  s.n = 2;
  refused(grid.get(), s, LSDCD_ERROR_ARGUMENT, "`centres` is null");
  s.centres = centres;
  s.half_axes = half;
  refused(grid.get(), s, LSDCD_ERROR_ARGUMENT, "nothing is asked for");
  s.first = first;
  refused(grid.get(), s, LSDCD_ERROR_INPUT,
          "grain 1: a half-axis of a shape is -1: half-axes are lengths above 0");
  s.one_shape = 2;
  refused(grid.get(), s, LSDCD_ERROR_ARGUMENT, "`one_shape` is 2: it is 0 or 1");
  s.one_shape = 1;
  s.quaternions = turns;
  refused(grid.get(), s, LSDCD_ERROR_INPUT,
          "grain 1 has a quaternion that is 0 or no number: give w i j k of a rotation");
  s.quaternions = nullptr;
  s.exponents = exponents + 2;
  refused(grid.get(), s, LSDCD_ERROR_INPUT,
          "grain 0: an exponent of a shape is 30: exponents are from 2, an ellipsoid, to 20");
  // Grain 0 has the exponents and the proportions of what follows, or numbers that are neither less nor more.
  s.one_shape = 0;
  const double ones[] = {1, 1, 1, 1, 1, 1}, below[] = {1, 1, 1, -1, -1, -1},
               no_length[] = {1, 1, 1, NAN, 1, 1}, fours[] = {4, 4, 4, 4},
               no_exponent[] = {4, 4, NAN, 4};
  s.exponents = fours;
  s.half_axes = below;
  refused(grid.get(), s, LSDCD_ERROR_INPUT, "grain 1: a half-axis of a shape is -1");
  s.half_axes = no_length;
  refused(grid.get(), s, LSDCD_ERROR_INPUT, "grain 1: a half-axis of a shape is nan");
  s.half_axes = ones;
  s.exponents = no_exponent;
  refused(grid.get(), s, LSDCD_ERROR_INPUT, "grain 1: an exponent of a shape is nan");
  lsdcd::GridOptions nearest(kCutoff);
  nearest.nearest = 4;
  s.exponents = nullptr;
  refused(lsdcd::Grid(mesh, nearest).get(), s, LSDCD_ERROR_ARGUMENT, "`nearest`");
}

TEST_F(Shape, is_infinitely_far_where_its_centre_is_no_number)
{
  lsdcd::Shapes g;
  g.centres = {NAN, 0, 0, 1e9, 0, 0};
  g.half_axes = {0.2, 0.1, 0.1};
  const lsdcd::ShapeDistances d = grid.shape_distances(g);
  EXPECT_TRUE(std::isinf(d.distance[0]));
  EXPECT_EQ(d.feature[0], LSDCD_NONE);
  EXPECT_NEAR(d.distance[1], 1e9 - 1.2, 1e-6);
  EXPECT_EQ(grid.shape_contacts(g).overlap.size(), 0u);
}

}    // namespace
}    // namespace test_library_shapes
