// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The lines by which pictures show a mesh.
#include "output/mesh_image.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace lsdcd::test_mesh_image {
namespace {

std::vector<ImageObject> drawn(const TriangleSoup &soup, Draw what)
{
  return draw_mesh(weld(soup, -1), what);
}

Real length_of(const std::vector<ImageObject> &lines)
{
  Real sum = 0;
  for (const ImageObject &l : lines) sum += norm(l.corner[1] - l.corner[0]);
  return sum;
}

// Whether one of the lines goes from a to b or back.
bool has_line(const std::vector<ImageObject> &lines, const Vec3 &a, const Vec3 &b)
{
  for (const ImageObject &l : lines) {
    EXPECT_EQ(l.corner[1], l.corner[2]);
    if ((l.corner[0] == a && l.corner[1] == b) || (l.corner[0] == b && l.corner[1] == a))
      return true;
  }
  return false;
}

TEST(mesh_image, the_edges_of_a_box_are_its_twelve_and_no_diagonal)
{
  const auto lines = drawn(box_mesh({0, 0, 0}, {1, 2, 4}), Draw::edges);
  EXPECT_EQ(lines.size(), 12u);
  EXPECT_EQ(length_of(lines), 4 * (1 + 2 + 4));
}

TEST(mesh_image, a_fold_is_drawn_above_30_degrees_whichever_way_its_sides_are_wound)
{
  for (const Real degrees : {29., 31., -29., -31.})
    for (const bool one_way : {true, false}) {
      TriangleSoup soup = hinge_mesh(degrees, 1);
      if (!one_way)
        for (std::size_t c = 0; c < soup.corners.size() / 2; c += 3)
          std::swap(soup.corners[c], soup.corners[c + 1]);
      EXPECT_EQ(has_line(drawn(soup, Draw::edges), {0, -1, 0}, {0, 1, 0}), std::fabs(degrees) > 30)
          << degrees << one_way;
    }
}

TEST(mesh_image, an_edge_of_three_faces_is_drawn_also_where_they_are_flat)
{
  TriangleSoup soup;
  const Vec3 a = {0, -1, 0}, b = {0, 1, 0};
  for (const Vec3 &c : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{-2, 0, 0}})
    soup.corners.insert(soup.corners.end(), {a, b, c});
  EXPECT_TRUE(has_line(drawn(soup, Draw::edges), a, b));
}

// The cuts of a box that is longest along one axis: how long each is, by its plane.
TEST(mesh_image, contours_are_nine_cuts_across_the_longest_side_and_one_across_the_others)
{
  for (int longest = 0; longest < 3; longest++) {
    Vec3 side = {1, 1, 1};
    side[longest] = 4.5;
    const auto lines = drawn(box_mesh({0, 0, 0}, side), Draw::contours);
    Real in_planes = 0;
    for (int axis = 0; axis < 3; axis++) {
      const int cuts = axis == longest ? 9 : 1;
      for (int k = 0; k < cuts; k++) {
        const Real level = side[axis] * (k + 0.5) / cuts;
        std::vector<ImageObject> cut;
        for (const ImageObject &l : lines)
          if (std::fabs(l.corner[0][axis] - level) < 1e-14 &&
              std::fabs(l.corner[1][axis] - level) < 1e-14)
            cut.push_back(l);
        const Real around = 2 * (side.x + side.y + side.z - side[axis]);
        EXPECT_NEAR(length_of(cut), around, 1e-13);
        in_planes += around;
      }
    }
    EXPECT_NEAR(length_of(lines), in_planes, 1e-12);
  }
}

// A torus of 24 x 24 quads: folds of 15 degrees, and no open edge.
TEST(mesh_image, a_mesh_without_edges_is_drawn_by_contours)
{
  constexpr int n = 24;
  std::vector<Vec3> x;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const Real a = 2 * kPi * i / n, b = 2 * kPi * j / n, r = 3 + std::cos(b);
      x.push_back({r * std::cos(a), r * std::sin(a), std::sin(b)});
    }
  const TriangleSoup torus = crumpled_torus(x, n);
  const Real by_edges = length_of(drawn(torus, Draw::edges));
  EXPECT_GT(by_edges, 0);
  EXPECT_EQ(by_edges, length_of(drawn(torus, Draw::contours)));
}

}    // namespace
}    // namespace lsdcd::test_mesh_image
