// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points at any distance against every triangle tried in more digits.
#include "support/brute_force_long.h"
#include "support/tree_case.h"

#include "mesh/meets_itself.h"
#include "mesh/winding_number.h"
#include "query/tree_query.h"
#include "tree/tree_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>

namespace lsdcd::test_triangle_tree {
namespace {

constexpr std::uint32_t kNoHint = kNoPrimitive;

struct Case : TreeCase {
  std::vector<LongTriangle<LongReal>> triangles;

  explicit Case(TriangleSoup given) :
      TreeCase(std::move(given)), triangles(long_triangles<LongReal>(soup))
  {
  }
  Real truth(const Vec3 &q) const
  {
    return long_distance(triangles.data(), int(triangles.size()), q);
  }
  // A distance is a sum of three products of numbers that are each off by 2 units, at most |q - anchor|,
  // which is less than the distance and the diagonal. A point is taken for one inside or past a side where
  // it is no farther from that than the same error. 32 units are more than both. A facet that is lower than
  // 8 units of its coordinates, or 1e-14 of its length, is its edges.
  Real tolerance(Real distance) const
  {
    return 32 * kRoundoff * (distance + diagonal) +
           std::fmax(8 * kRoundoff * size, 1e-14 * diagonal);
  }
};

const std::vector<std::unique_ptr<Case>> &all_cases()
{
  static const auto made = cases_of<Case>(
      {cylinder_mesh(24, 6, 1, 2), box_mesh({0, 0, 0}, {1, 2, 3}), cone_mesh(200, 1, 0.5)},
      std::getenv("LSDCD_QUICK") ? 40 : 200);
  return made;
}

bool same(const TreeAnswer &a, const TreeAnswer &b)
{
  return a.distance == b.distance && a.feature == b.feature;
}

TEST(triangle_tree, gives_the_distance_of_every_triangle_tried)
{
  for (const bool wide : {true, false}) {
    const bool usual = TriangleTree::wide();
    if (!wide) TriangleTree::wide() = false;
    for (const auto &c : all_cases())
      for (const Vec3 &q : c->points(200, 7)) {
        const Real truth = c->truth(q), found = c->tree.nearest(q, kAnyDistance, kNoHint).distance;
        ASSERT_NEAR(found, truth, c->tolerance(truth)) << c->soup.source;
      }
    TriangleTree::wide() = usual;
  }
}

// In the middle of a flat triangle at coordinates of 1e6. Its sides are half its height away; the page of the
// library has these numbers.
TEST(triangle_tree, a_triangle_lower_than_8_round_offs_of_its_coordinates_is_its_sides)
{
  const Real far = 1e6;
  for (const Real height : {1.7e-9, 1.8e-9}) {
    TriangleSoup soup;
    soup.source = "low";
    soup.corners = {{far, 0, 0}, {far + 1, 0, 0}, {far + 0.5, height, 0}};
    const TreeCase c(soup);
    const bool is_low = height < 8 * kRoundoff * far;
    EXPECT_EQ(c.mesh.faces.empty(), is_low);
    const Real found = c.tree.nearest({far + 0.5, height / 2, 0}, kAnyDistance, kNoHint).distance;
    EXPECT_NEAR(found, is_low ? height / 2 : 0, 1e-14);
  }
}

TEST(triangle_tree, answers_do_not_depend_on_the_radius)
{
  for (const auto &c : all_cases())
    for (const Vec3 &q : c->points(100, 8)) {
      const TreeAnswer any = c->tree.nearest(q, kAnyDistance, kNoHint);
      ASSERT_TRUE(any.found());
      for (const Real radius : {1e-3 * c->diagonal, c->diagonal, 1e3 * c->diagonal, any.distance,
                                std::nextafter(any.distance, HUGE_VAL)}) {
        const TreeAnswer a = c->tree.nearest(q, radius, kNoHint);
        ASSERT_EQ(a.found(), any.distance < radius) << c->soup.source;
        ASSERT_TRUE(!a.found() || same(a, any)) << c->soup.source;
      }
    }
}

TEST(triangle_tree, answers_do_not_depend_on_the_hint)
{
  Numbers r(9);
  for (const auto &c : all_cases())
    for (const Vec3 &q : c->points(50, 9)) {
      const TreeAnswer any = c->tree.nearest(q, kAnyDistance, kNoHint);
      for (int k = 0; k < 4; k++) {
        const std::uint32_t hint = r.below(int(c->tree.n_primitives()));
        ASSERT_TRUE(same(c->tree.nearest(q, kAnyDistance, hint), any)) << c->soup.source;
      }
    }
}

TEST(triangle_tree, closest_points_lie_where_they_say)
{
  for (const auto &c : all_cases())
    for (const Vec3 &q : c->points(50, 10)) {
      const TreeAnswer a = c->tree.nearest(q, kAnyDistance, kNoHint);
      Vec3 point, normal;
      c->tree.closest(a, q, point, normal);
      // As above, and the rounding of the point itself.
      const Real size = norm(c->mesh.report.lo) + norm(c->mesh.report.hi);
      const Real off = c->tolerance(a.distance) + 8 * kRoundoff * size;
      ASSERT_NEAR(norm(normal), 1, 8 * kRoundoff) << c->soup.source;
      ASSERT_NEAR(norm(q - point), a.distance, off) << c->soup.source;
      ASSERT_LE(c->truth(point), off) << c->soup.source;
    }
}

// A GPU's threads share this search; here one thread is all of them.
TEST(triangle_tree, the_search_for_gpus_finds_the_same)
{
  for (const auto &c : all_cases())
    for (const Vec3 &q : c->points(200, 13)) {
      const TreeView &view = c->tree.view();
      if (view.search_for(view.scaled(q)) == TreeSearch::in_double) continue;
      for (const Real radius : {kAnyDistance, 0.1 * c->diagonal}) {
        TreeWaiting stack[kTreeStack];
        TreeAnswer a = {radius, kNoFeature, kNoPrimitive};
        search_tree<TreeBoundsFloat>(c->tree.view(), Warp<1>(), q, stack, a);
        if (!a.found()) a.distance = kAnyDistance;
        ASSERT_TRUE(same(a, c->tree.nearest(q, radius, kNoHint))) << c->soup.source;
      }
    }
}

// Winding numbers are exact. A point is left out where rounding cannot tell it from one on the mesh.
TEST(triangle_tree, normals_tell_the_sides_that_winding_numbers_tell)
{
  std::size_t inside = 0;
  for (const auto &c : all_cases()) {
    if (!c->mesh.report.closed || !c->mesh.report.oriented || meets_itself(c->mesh).pairs > 0)
      continue;
    const WindingNumber winding(c->mesh);
    for (const Vec3 &q : c->points(500, 14)) {
      const TreeAnswer a = c->tree.nearest(q, kAnyDistance, kNoHint);
      if (a.distance < c->tolerance(0)) continue;
      Vec3 point, normal;
      c->tree.closest(a, q, point, normal);
      const int side = c->tree.view().side(a, q, point, normal);
      // Facets without area have no side.
      const bool has_face = c->names.view().of(a.feature) != kNoTriangle;
      ASSERT_EQ(side, has_face ? winding.side(q) : 0) << c->soup.source;
      inside += side < 0;
    }
  }
  EXPECT_GT(inside, 100u);
}

// From far away all features are as far, up to rounding, so that one of the far side may be found.
TEST(triangle_tree, points_far_outside_are_outside)
{
  for (const Real height : {1., 1e-7}) {
    const Case c(box_mesh({0, 0, 0}, {1, 2, height}));
    Numbers r(15);
    for (int k = 0; k < 20000; k++) {
      const Vec3 q = r.log_in(10, 1e149) * r.direction();
      const TreeAnswer a = c.tree.nearest(q, kAnyDistance, kNoHint);
      Vec3 point, normal;
      c.tree.closest(a, q, point, normal);
      ASSERT_EQ(c.tree.view().side(a, q, point, normal), 1) << norm(q);
    }
  }
}

// More than stays in a cache, so that the points are put in order.
TEST(triangle_tree, many_points_get_what_each_alone_gets)
{
  const Case c(cylinder_mesh(100, 49, 50, 100));
  const std::vector<Vec3> points = c.points(20000, 11);
  std::vector<double> distance(points.size()), closest(3 * points.size());
  std::vector<std::uint32_t> feature(points.size());
  for (const Real cutoff : {1., 0.}) {
    PointArrays<double> io;
    io.n = points.size();
    io.points = {&points[0].x, 3, 1};
    io.radius = cutoff > 0 ? cutoff : kAnyDistance;
    io.distance = {distance.data(), 1};
    io.closest = {closest.data(), 3, 1};
    io.feature = feature.data();
    std::unique_ptr<CutoffBoxes> near;
    if (cutoff > 0) near = std::make_unique<CutoffBoxes>(c.tree, c.mesh, cutoff);
    query_tree(c.tree, near.get(), io.radius, io);
    std::size_t found = 0;
    for (std::size_t i = 0; i < points.size(); i++) {
      const TreeAnswer alone = c.tree.nearest(points[i], io.radius, kNoHint);
      ASSERT_EQ(feature[i], alone.feature);
      ASSERT_EQ(distance[i], alone.found() ? alone.distance : HUGE_VAL);
      found += alone.found();
    }
    EXPECT_GT(found, points.size() / 10);
  }
}

}    // namespace
}    // namespace lsdcd::test_triangle_tree
