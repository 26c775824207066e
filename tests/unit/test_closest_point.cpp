// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Closest points on faces, edges and vertices against closed forms and long double.
#include "geometry/closest_point.h"
#include "mesh/mesh_features.h"
#include "support/brute_force_long.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

namespace lsdcd::test_closest_point {
namespace {

// The records of a soup, with the view that a query takes.
struct Wall {
  WeldedMesh mesh;
  MeshFeatures features;
  MeshFeaturesView view;

  explicit Wall(const std::vector<Vec3> &corners, bool sides = false) :
      mesh(weld({corners, "test"}, 0)), features(make_features(mesh, sides)), view(features.view())
  {
  }
  explicit Wall(const TriangleSoup &soup) : Wall(soup.corners) {}

  int vertex_at(const Vec3 &p) const
  {
    for (std::size_t i = 0; i < mesh.vertices.size(); i++)
      if (mesh.vertices[i] == p) return static_cast<int>(i);
    return -1;
  }
  int edge_between(const Vec3 &a, const Vec3 &b) const
  {
    const int i = vertex_at(a), j = vertex_at(b);
    for (std::size_t e = 0; e < mesh.edges.size(); e++)
      if (mesh.edges[e][0] == std::min(i, j) && mesh.edges[e][1] == std::max(i, j))
        return static_cast<int>(e);
    return -1;
  }
  ClosestPoint on_face(int i, const Vec3 &q, Real tolerance = 0) const
  {
    return closest_point_on(view, feature_code(FeatureKind::face, i), q, tolerance);
  }
  ClosestPoint on_edge(const Vec3 &a, const Vec3 &b, const Vec3 &q, Real tolerance = 0) const
  {
    return closest_point_on(view, feature_code(FeatureKind::edge, edge_between(a, b)), q,
                            tolerance);
  }
  ClosestPoint on_vertex(const Vec3 &p, const Vec3 &q, Real tolerance = 0) const
  {
    return closest_point_on(view, feature_code(FeatureKind::vertex, vertex_at(p)), q, tolerance);
  }
  // The closest point on any feature, in the lists of cells or not.
  Real nearest(const Vec3 &q, Real tolerance) const
  {
    Real least = HUGE_VAL;
    const auto try_one = [&](FeatureKind kind, std::size_t n) {
      for (std::size_t i = 0; i < n; i++) {
        const ClosestPoint f =
            closest_point_on(view, feature_code(kind, static_cast<std::uint32_t>(i)), q, tolerance);
        if (f.found) least = std::fmin(least, f.distance);
      }
    };
    try_one(FeatureKind::face, features.faces.size());
    try_one(FeatureKind::edge, features.edges.size());
    try_one(FeatureKind::vertex, features.vertices.size());
    return least;
  }
  int kept(FeatureKind kind) const
  {
    return static_cast<int>(std::count_if(features.contact_features.begin(),
                                          features.contact_features.end(),
                                          [&](FeatureCode f) { return feature_kind(f) == kind; }));
  }
};

const Vec3 kA = {0, 0, 0}, kB = {4, 0, 0}, kC = {0, 3, 0};    // 3-4-5

// ---- regions -------------------------------------------------------------------------

TEST(face, holds_the_points_of_its_prism)
{
  const Wall wall({kA, kB, kC});
  EXPECT_TRUE(wall.on_face(0, {1, 1, 0.5}).found);
  EXPECT_TRUE(wall.on_face(0, {1, 1, -0.5}).found);
  EXPECT_FALSE(wall.on_face(0, {-0.001, 1, 0.5}).found);
  EXPECT_FALSE(wall.on_face(0, {1, -0.001, 0.5}).found);
  EXPECT_FALSE(wall.on_face(0, {2, 1.501, 0.5}).found);
  EXPECT_TRUE(wall.on_face(0, {2, 1.499, 0.5}).found);
}

TEST(face, has_the_height_as_distance_and_a_normal_towards_the_centre)
{
  const Wall wall({kA, kB, kC});
  for (Real z : {0.5, -0.25, 1e-12, -1e-300}) {
    const ClosestPoint f = wall.on_face(0, {1, 1, z});
    EXPECT_EQ(f.distance, std::fabs(z));
    EXPECT_EQ(f.normal, (Vec3{0, 0, z > 0 ? 1. : -1.}));
  }
}

TEST(face, slack_widens_its_prism_by_a_length)
{
  const Wall wall({kA, kB, kC});
  for (const Vec3 &q : {Vec3{1, -0.1, 1}, Vec3{-0.1, 1, 1}, Vec3{2 + 0.06, 1.5 + 0.08, 1}}) {
    EXPECT_FALSE(wall.on_face(0, q, 0.0999).found);
    EXPECT_TRUE(wall.on_face(0, q, 0.1001).found);
  }
}

TEST(vertex, one_inside_a_plane_or_a_straight_fold_has_no_foot_and_no_directions)
{
  // A floor of four triangles round its middle, flat or folded along one diagonal.
  for (const Real up : {0., 0.5}) {
    const Vec3 a = {0, 0, 0}, b = {2, 0, up}, c = {2, 2, 0}, d = {0, 2, up}, middle = {1, 1, 0};
    const Wall wall({a, b, middle, b, c, middle, c, d, middle, d, a, middle});
    EXPECT_EQ(wall.kept(FeatureKind::vertex), 4);
    for (const Real z : {0., 0.5, -0.5})
      EXPECT_FALSE(wall.on_vertex(middle, {1, 1, z}, 1e-9).found);
    EXPECT_TRUE(wall.on_face(0, {1, 0.9999, 0.5}).found);
    EXPECT_EQ(wall.features.vertex_direction.size(), 1u + 4 * 3);
  }
}

TEST(edge, free_one_holds_the_half_cylinder_away_from_its_face)
{
  const Wall wall({kA, kB, kC});
  const ClosestPoint f = wall.on_edge(kA, kB, {1, -0.3, 0.4});
  ASSERT_TRUE(f.found);
  EXPECT_NEAR(f.distance, 0.5, 2 * kRoundoff);
  EXPECT_LE(norm(f.normal - Vec3{0, -0.6, 0.8}), 4 * kRoundoff);
  EXPECT_FALSE(wall.on_edge(kA, kB, {1, 0.001, 0.4}).found);
  EXPECT_FALSE(wall.on_edge(kA, kB, {-0.001, -0.3, 0.4}).found);
  EXPECT_FALSE(wall.on_edge(kA, kB, {4.001, -0.3, 0.4}).found);
}

TEST(edge, convex_one_holds_its_wedge)
{
  const Wall wall(box_mesh({0, 0, 0}, {1, 1, 1}));
  const Vec3 a = {1, 0, 1}, b = {1, 1, 1};
  EXPECT_TRUE(wall.on_edge(a, b, {1.3, 0.5, 1.4}).found);
  EXPECT_NEAR(wall.on_edge(a, b, {1.3, 0.5, 1.4}).distance, 0.5, 4 * kRoundoff);
  EXPECT_FALSE(wall.on_edge(a, b, {0.999, 0.5, 1.4}).found);
  EXPECT_FALSE(wall.on_edge(a, b, {1.3, 0.5, 0.999}).found);
  // From inside the two faces are nearer, however near the edge.
  EXPECT_FALSE(wall.on_edge(a, b, {0.99, 0.5, 0.99}).found);
}

TEST(vertex, convex_one_holds_its_cone)
{
  const Wall wall(box_mesh({0, 0, 0}, {1, 1, 1}));
  const ClosestPoint f = wall.on_vertex({1, 1, 1}, {3, 4, 7});
  ASSERT_TRUE(f.found);
  EXPECT_NEAR(f.distance, 7, 8 * kRoundoff);
  EXPECT_LE(norm(f.normal - Vec3{2. / 7, 3. / 7, 6. / 7}), 4 * kRoundoff);
  // At every corner: out along two axes but not along the third.
  for (const Vec3 &p : wall.mesh.vertices)
    for (int k = 0; k < 3; k++) {
      const Vec3 out = 2 * p - Vec3{1, 1, 1};
      Vec3 q = p + 0.1 * out;
      EXPECT_TRUE(wall.on_vertex(p, q).found);
      q[k] = p[k] - 0.001 * out[k];
      EXPECT_FALSE(wall.on_vertex(p, q).found);
    }
}

TEST(vertex, slack_widens_its_cone_by_a_length)
{
  const Wall wall(box_mesh({0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(wall.on_vertex({1, 1, 1}, {0.9, 2, 2}, 0.099).found);
  EXPECT_TRUE(wall.on_vertex({1, 1, 1}, {0.9, 2, 2}, 0.101).found);
}

// ---- slivers against more digits ----------------------------------------------------

// A triangle of length 1 and height 1 / aspect, its apex anywhere along it.
std::array<Vec3, 3> sliver(Random &random, Real aspect)
{
  const Vec3 u = random_unit(random);
  Vec3 v = cross(u, random_unit(random));
  v = (1 / norm(v)) * v;
  const Vec3 at = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  std::array<Vec3, 3> p = {at, at + u, at + uniform(random, -0.2, 1.2) * u + (1 / aspect) * v};
  std::shuffle(p.begin(), p.end(), random);
  return p;
}

// Distances of slivers are those of long double to `tolerance`, the tolerance: a
// point within it of a region may be answered by the neighbouring one.
void expect_exact_slivers(Real aspect, Real tolerance)
{
  Random random(1);
  Real largest = 0;
  for (int i = 0; i < 300; i++) {
    const auto p = sliver(random, aspect);
    const Wall wall({p[0], p[1], p[2]});
    const auto exact = long_triangles<LongReal>({{p[0], p[1], p[2]}, "sliver"});
    ASSERT_EQ(wall.features.faces.size(), 1u);
    for (int k = 0; k < 300; k++) {
      Real s = uniform(random, 0, 1), t = uniform(random, 0, 1);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      const Real away = std::pow(10., uniform(random, -10, 0));
      const Vec3 q = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]) + away * random_unit(random);
      const Real d = wall.nearest(q, tolerance / 4);
      ASSERT_LT(d, HUGE_VAL) << "no feature answers";
      largest = std::fmax(largest, std::fabs(d - long_distance(exact.data(), 1, q)));
    }
  }
  std::printf("  aspect %g: largest error %.2g of the length\n", aspect, largest);
  EXPECT_LE(largest, tolerance);
}

// The grid's bound for the rounding of dot products, 16 roundings of a size of
// 1 to 2, times four.
constexpr Real kSliverTolerance = 4 * 32 * kRoundoff;
TEST(sliver, of_any_aspect_has_exact_distances)
{
  for (const Real aspect : {10., 1e4, 1e8}) expect_exact_slivers(aspect, kSliverTolerance);
}

TEST(sliver, of_aspect_1e8_has_a_normal_square_to_its_sides)
{
  Random random(2);
  for (int i = 0; i < 1000; i++) {
    const auto p = sliver(random, 1e8);
    const Wall wall({p[0], p[1], p[2]});
    const Vec3 n = wall.features.faces[0].normal;
    EXPECT_NEAR(norm(n), 1, 2 * kRoundoff);
    for (int k = 0; k < 3; k++) {
      const LongVec3<LongReal> e = from_to<LongReal>(p[k], p[(k + 1) % 3]);
      // The rounding of the normal's own components.
      EXPECT_LE(std::fabs(dot(LongVec3<LongReal>{n.x, n.y, n.z}, e)),
                2 * kRoundoff * std::sqrt(dot(e, e)));
    }
  }
}

// ---- centres on the wall -----------------------------------------------------------------

void expect_unit(const ClosestPoint &f)
{
  EXPECT_TRUE(f.found);
  EXPECT_LE(f.distance, 2 * kRoundoff);    // the middle of an edge may be off it by a rounding
  EXPECT_NEAR(norm(f.normal), 1, 4 * kRoundoff);
}

TEST(centre_on_a_face, has_the_normal_of_the_winding)
{
  const Wall wall({kA, kB, kC}), turned({kA, kC, kB});
  expect_unit(wall.on_face(0, {1, 1, 0}));
  EXPECT_EQ(wall.on_face(0, {1, 1, 0}).normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(turned.on_face(0, {1, 1, 0}).normal, (Vec3{0, 0, -1}));
}

TEST(centre_on_an_edge, has_a_unit_normal)
{
  for (const TriangleSoup &soup : {box_mesh({0, 0, 0}, {1, 1, 1}), floor_mesh(2, 1),
                                   hinge_mesh(30, 1), hinge_mesh(-1e-9, 1)}) {
    const Wall wall(soup);
    for (std::size_t e = 0; e < wall.features.edges.size(); e++) {
      const auto &v = wall.mesh.edges[e];
      const Vec3 a = wall.mesh.vertices[v[0]], b = wall.mesh.vertices[v[1]];
      expect_unit(wall.on_edge(a, b, 0.5 * (a + b), 1e-15));
    }
  }
}

TEST(centre_on_an_edge, is_pushed_away_from_its_faces)
{
  const Wall box(box_mesh({0, 0, 0}, {1, 1, 1}));
  const Real s = std::sqrt(0.5);
  EXPECT_LE(norm(box.on_edge({1, 0, 1}, {1, 1, 1}, {1, 0.5, 1}).normal - Vec3{s, 0, s}),
            4 * kRoundoff);
  const Wall one({kA, kB, kC});
  EXPECT_LE(norm(one.on_edge(kA, kB, {1, 0, 0}).normal - Vec3{0, -1, 0}), 4 * kRoundoff);
}

TEST(centre_on_a_vertex, has_a_unit_normal)
{
  for (const TriangleSoup &soup : {box_mesh({0, 0, 0}, {1, 1, 1}), floor_mesh(2, 1),
                                   floor_mesh(3, 1, 5), cylinder_mesh(7, 2, 1, 1)}) {
    const Wall wall(soup);
    for (FeatureCode code : wall.features.contact_features)
      if (feature_kind(code) == FeatureKind::vertex)
        expect_unit(closest_point_on(wall.view, code,
                                     wall.features.vertices[feature_index(code)].position, 0));
  }
}

TEST(centre_on_a_bare_edge, has_a_unit_normal)
{
  // A facet of two points leaves an edge without faces.
  const Wall wall({kA, kB, kB, kA, kB, kC});
  Wall bare({kA, kB, kB});
  ASSERT_EQ(bare.features.faces.size(), 0u);
  expect_unit(bare.on_edge(kA, kB, {1, 0, 0}));
  expect_unit(bare.on_vertex(kA, kA));
}

// ---- which features are kept ----------------------------------------------------------------

TEST(wall_features, of_a_floor_are_its_faces_rim_and_corners)
{
  for (unsigned seed : {0, 1, 2}) {
    const Wall wall(floor_mesh(5, 1, seed));
    EXPECT_EQ(wall.kept(FeatureKind::face), 50);
    EXPECT_EQ(wall.kept(FeatureKind::edge), 20);
    EXPECT_EQ(wall.kept(FeatureKind::vertex), 4);
  }
}

TEST(wall_features, of_a_cylinder_leave_out_vertices_inside_straight_folds)
{
  const Wall wall(cylinder_mesh(16, 4, 1, 2));
  EXPECT_EQ(wall.kept(FeatureKind::edge), 16 * 4 + 2 * 16);
  EXPECT_EQ(wall.kept(FeatureKind::vertex), 2 * 16);
}

TEST(wall_features, keep_a_fold_of_a_millionth_of_a_degree)
{
  EXPECT_EQ(Wall(hinge_mesh(1e-6, 1)).kept(FeatureKind::edge), 6 + 1);
  EXPECT_EQ(Wall(hinge_mesh(-1e-6, 1)).kept(FeatureKind::edge), 6 + 1);
  EXPECT_EQ(Wall(hinge_mesh(0, 1)).kept(FeatureKind::edge), 6);
}

TEST(wall_features, do_not_depend_on_winding)
{
  TriangleSoup soup = cylinder_mesh(16, 4, 1, 2);
  const Wall as_given(soup);
  for (std::size_t t = 0; t < soup.n_triangles(); t += 3)
    std::swap(soup.corners[3 * t], soup.corners[3 * t + 1]);
  const Wall mixed(soup);
  EXPECT_EQ(as_given.kept(FeatureKind::edge), mixed.kept(FeatureKind::edge));
  EXPECT_EQ(as_given.kept(FeatureKind::vertex), mixed.kept(FeatureKind::vertex));
  Random random(3);
  for (int i = 0; i < 2000; i++) {
    const Vec3 q = {uniform(random, -2, 2), uniform(random, -2, 2), uniform(random, -1, 3)};
    ASSERT_NEAR(as_given.nearest(q, 1e-14), mixed.nearest(q, 1e-14), 4e-15);
  }
}

// Three faces on the x axis, at 0, 100 and 200 degrees about it.
std::vector<Vec3> three_on_an_edge()
{
  std::vector<Vec3> corners;
  for (int k = 0; k < 3; k++) {
    const Real a = 100 * k * kPi / 180;
    corners.insert(corners.end(), {{0, 0, 0}, {1, 0, 0}, {0.3, std::cos(a), std::sin(a)}});
  }
  return corners;
}

TEST(nonmanifold_edge, keeps_the_inward_normals_of_all_its_faces)
{
  const Wall wall(three_on_an_edge());
  const EdgeRecord &e = wall.features.edges[wall.edge_between({0, 0, 0}, {1, 0, 0})];
  ASSERT_EQ(e.n_faces, 3u);
  std::vector<Vec3> inward = {e.inward[0], e.inward[1], wall.features.edge_inward[e.more]};
  for (int k = 0; k < 3; k++) {
    const Real a = 100 * k * kPi / 180;
    Real nearest = 2;
    for (const Vec3 &v : inward)
      nearest = std::fmin(nearest, norm(v - Vec3{0, std::cos(a), std::sin(a)}));
    EXPECT_LE(nearest, 4 * kRoundoff);
  }
}

TEST(nonmanifold_edge, with_its_faces_on_one_side_answers_from_the_other)
{
  std::vector<Vec3> corners;
  for (int k = -1; k <= 1; k++) {
    const Real a = 30 * k * kPi / 180;
    corners.insert(corners.end(), {{0, 0, 0}, {1, 0, 0}, {0.3, std::cos(a), std::sin(a)}});
  }
  const Wall wall(corners);
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const Real b = degrees * kPi / 180;
    EXPECT_EQ(wall.on_edge({0, 0, 0}, {1, 0, 0}, {0.5, std::cos(b), std::sin(b)}).found,
              degrees > 120 && degrees < 240)
        << degrees;
  }
}

TEST(wall_features, sides_point_out_of_a_box)
{
  const Wall wall(box_mesh({0, 0, 0}, {1, 1, 1}).corners, true);
  const Vec3 middle = {0.5, 0.5, 0.5};
  for (std::size_t i = 0; i < wall.mesh.vertices.size(); i++) {
    const Vec3 out = wall.features.vertex_out[i];
    // Angle-weighted: the three sides count alike whatever their diagonals.
    const Vec3 expected = wall.mesh.vertices[i] - middle;
    EXPECT_LE(norm((1 / norm(out)) * out - (1 / norm(expected)) * expected), 1e-15);
  }
  for (std::size_t i = 0; i < wall.features.edge_out.size(); i++) {
    const auto &e = wall.mesh.edges[i];
    const Vec3 mid = 0.5 * (wall.mesh.vertices[e[0]] + wall.mesh.vertices[e[1]]);
    EXPECT_GT(dot(wall.features.edge_out[i], mid - middle), 0.5);
  }
}

// Wedges along z from angle `from` to angle `to`, with their edge on the axis.
void add_wedge(TriangleSoup &soup, Real from, Real to)
{
  const auto place = [](Real angle, Real z) {
    return Vec3{2 * std::cos(angle), 2 * std::sin(angle), z};
  };
  const Vec3 a = {0, 0, 0}, b = place(from, 0), c = place(to, 0), d = {0, 0, 1}, e = place(from, 1),
             f = place(to, 1);
  for (const auto &t : {std::array<Vec3, 3>{a, c, b},
                        {d, e, f},
                        {a, b, e},
                        {a, e, d},
                        {b, c, f},
                        {b, f, e},
                        {c, a, d},
                        {c, d, f}})
    soup.corners.insert(soup.corners.end(), t.begin(), t.end());
}

// Where the edge is what is nearest, a point is outside of both.
TEST(wall_features, sides_point_out_at_an_edge_along_which_two_solids_touch)
{
  Random random(5);
  int directions = 0;
  for (int i = 0; i < 200; i++) {
    const Real first = uniform(random, 0.2, 2.9), second = uniform(random, 0.2, 2.9);
    const Real gap = uniform(random, 0.05, 2 * kPi - first - second);
    if (first + second + gap > 2 * kPi - 0.05) continue;
    const Real bounds[4] = {0, first, first + gap, first + gap + second};
    TriangleSoup soup;
    add_wedge(soup, bounds[0], bounds[1]);
    add_wedge(soup, bounds[2], bounds[3]);
    const Wall wall(soup.corners, true);
    std::size_t shared = 0;
    while (wall.mesh.edge_first[shared + 1] - wall.mesh.edge_first[shared] != 4) shared++;
    for (Real angle = 0.01; angle < 2 * kPi; angle += 0.05) {
      const Vec3 direction = {std::cos(angle), std::sin(angle), 0};
      bool is_nearest = true;    // the edge, of all the wall
      for (const Real b : bounds) is_nearest = is_nearest && std::cos(angle - b) < 0;
      if (!is_nearest) continue;
      EXPECT_GT(dot(wall.features.edge_out[shared], direction), 0) << angle;
      directions++;
    }
  }
  EXPECT_GT(directions, 200);
}

}    // namespace
}    // namespace lsdcd::test_closest_point
