// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "mesh/placement.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_placement {
namespace {

// Distance of two points, for the cases that round.
Real apart(const Vec3 &a, const Vec3 &b)
{
  return norm(a - b);
}

TriangleSoup one_triangle()
{
  TriangleSoup soup;
  soup.source = "part.stl";
  soup.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return soup;
}

Vec3 normal_of(const TriangleSoup &soup)
{
  return cross(soup.corners[1] - soup.corners[0], soup.corners[2] - soup.corners[0]);
}

TEST(placement, quarter_turns_are_exact)
{
  const Vec3 axes[3] = {{0.1, 0, 0}, {0, 0.3, 0}, {0, 0, 7}};
  for (const Vec3 &axis : axes)
    for (const Real degrees : {-450., -270., -90., 90., 180., 270., 360., 36000090.}) {
      Placement p;
      p.rotate(axis, degrees);
      for (int i = 0; i < 3; ++i) {
        Vec3 unit = {0, 0, 0};
        unit[i] = 1;
        const Vec3 image = p.apply(unit);
        for (int j = 0; j < 3; ++j)
          EXPECT_TRUE(image[j] == 0 || image[j] == 1 || image[j] == -1) << image[j];
      }
    }
}

TEST(placement, rotation_about_a_diagonal_permutes_the_axes)
{
  Placement p;
  p.rotate({1, 1, 1}, 120);
  EXPECT_LT(apart(p.apply(Vec3{1, 2, 3}), {3, 1, 2}), 16 * kRoundoff);    // 9 rounded products
}

TEST(placement, rotation_keeps_the_axis_and_lengths)
{
  Placement p;
  p.rotate({1, -2, 3}, 37);
  EXPECT_LT(apart(p.apply(Vec3{1, -2, 3}), {1, -2, 3}), 32 * kRoundoff);
  EXPECT_NEAR(norm(p.apply(Vec3{3, 1, -2})), std::sqrt(14.), 32 * kRoundoff);
}

TEST(placement, a_mirror_keeps_orientation)
{
  auto soup = one_triangle();    // its normal is +z
  Placement p;
  p.scale({-1, 1, 1});
  p.apply(soup);
  EXPECT_GT(normal_of(soup).z, 0);
  EXPECT_EQ(soup.corners[2], (Vec3{-1, 0, 0}));
}

TEST(placement, two_mirrors_swap_no_corners)
{
  auto soup = one_triangle();
  Placement p;
  p.scale({-1, -1, 1});
  p.apply(soup);
  EXPECT_EQ(soup.corners[1], (Vec3{-1, 0, 0}));
}

TEST(placement, a_mirror_at_a_tiny_scale_is_seen)
{
  auto soup = one_triangle();
  Placement p;
  p.scale({-1e-150, 1e-150, 1e-150});    // the determinant is below the smallest double
  p.apply(soup);
  EXPECT_EQ(soup.corners[2].x, -1e-150);
}

TEST(placement, the_identity_leaves_every_bit)
{
  auto soup = one_triangle();
  soup.corners[0] = {-0.0, 5e-324, 1e308};
  Placement().apply(soup);
  EXPECT_TRUE(std::signbit(soup.corners[0].x));
  EXPECT_EQ(soup.corners[0].y, 5e-324);
}

TEST(placement, factors_axes_and_numbers_that_are_none_are_refused)
{
  Placement p;
  EXPECT_TRUE(fails_with("scale 1 0 1", [&] { p.scale({1, 0, 1}); }));
  EXPECT_TRUE(fails_with("the axis is zero", [&] { p.rotate({0, 0, 0}, 90); }));
  EXPECT_THROW(p.scale({1, NAN, 1}), InputError);
  EXPECT_THROW(p.rotate({INFINITY, 0, 0}, 90), InputError);
  EXPECT_THROW(p.rotate({1, 0, 0}, NAN), InputError);
  EXPECT_THROW(p.move({0, 0, INFINITY}), InputError);
}

TEST(placement, a_matrix_acts_on_what_came_before_it)
{
  const Vec3 shear[3] = {{1, 0.5, 0}, {0, 2, 0}, {0.25, 0, -1}};
  Placement p;
  p.move({1, 2, 3});
  p.matrix(shear, {10, 20, 30});
  p.scale({1, 1, 2});
  EXPECT_EQ(p.apply(Vec3{1, 1, 1}), (Vec3{2 + 1.5 + 10, 6 + 20, 2 * (0.5 - 4 + 30)}));
  auto soup = one_triangle();
  p.apply(soup);    // mirrored, as the determinant is -4
  EXPECT_EQ(soup.corners[2], p.apply(Vec3{1, 0, 0}));
}

TEST(placement, a_matrix_that_would_make_the_mesh_flat_is_refused)
{
  const Vec3 flat[][3] = {{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}},
                          {{0.1, 0.2, 0.3}, {0.3, 0.1, 0.7}, {0.4, 0.3, 1}},    // but for rounding
                          {{1e-150, 0, 0}, {0, 1e-150, 0}, {1e-150, 1e-150, 0}},
                          {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Placement p;
  for (const auto &m : flat)
    EXPECT_TRUE(fails_with("so that it would make the mesh flat", [&] { p.matrix(m, {}); }));
  const Vec3 huge[3] = {{1e200, 0, 0}, {0, 1e200, 0}, {0, 0, 1}};
  EXPECT_TRUE(fails_with("is not finite: give smaller numbers", [&] { p.matrix(huge, {}); }));
  const Vec3 tiny[3] = {{0, 1e-150, 0}, {-1e-150, 0, 0}, {1e-150, 0, 1e-150}},
             none[3] = {{NAN, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_THROW(p.matrix(none, {}), InputError);
  EXPECT_THROW(p.matrix(tiny, {0, INFINITY, 0}), InputError);
  EXPECT_TRUE(p.is_identity());    // nothing of these has stayed
  p.matrix(tiny, {});              // the determinant is below the smallest double, and not 0
  EXPECT_EQ(p.apply(Vec3{0, 1, 0}).x, 1e-150);
}

TEST(placement, a_part_that_keeps_its_size_is_known)
{
  Placement p;
  p.rotate({1, 2, 3}, 40);
  p.move({1, 2, 3});
  EXPECT_FALSE(p.stretches());
  p.scale({1, 1, 1.001});
  EXPECT_TRUE(p.stretches());
}

TEST(placement, overflow_names_the_file_and_the_facet)
{
  const auto error = error_of([] {
    Placement p;
    auto soup = one_triangle();
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, {1e300, 0, 0}, {0, 1, 0}});
    p.scale({1e10, 1, 1});
    p.apply(soup);
  });
  EXPECT_TRUE(has(error, "part.stl, facet 2: the corner 1e+300 0 0 overflows"));
}

}    // namespace
}    // namespace lsdcd::test_placement
