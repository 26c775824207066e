// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A body against the wall: pairs against a test of all triangles with all, of which the triangle
// test has its own oracle (test_triangles, test_triangles_cgal).
#include "base/input_error.h"
#include "bodies/body_collision.h"
#include "grid/lookup/locate.h"
#include "support/device.h"
#include "support/random_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lsdcd::test_bodies {
namespace {

BodyPose random_pose(Numbers &r, const Vec3 &from, const Vec3 &to)
{
  BodyPose pose;
  const Vec3 u = r.direction(), v = any_perpendicular(u), w = cross(u, v);
  pose.row[0] = u, pose.row[1] = v, pose.row[2] = w;
  pose.shift = to - (pose.corner_at(from) - pose.shift);
  return pose;
}

// Every primitive of the wall with every triangle of the body.
std::vector<BodyPair> all_pairs(const BodyGrid &grid, const TriangleSoup &body,
                                const BodyPose &pose)
{
  const MeshFeatures &wall = grid.wall;
  const auto at = [&](int v) { return wall.vertices[v].position; };
  std::vector<BodyPair> pairs;
  for (std::uint32_t t = 0; t < body.n_triangles(); t++) {
    const Vec3 *c = &body.corners[3 * t];
    const Triangle posed = {{pose.corner_at(c[0]), pose.corner_at(c[1]), pose.corner_at(c[2])}};
    for (const FeatureCode code : wall.primitives) {
      const std::uint32_t i = feature_index(code);
      Triangle other = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
      for (int k = 0; k < 3; k++) switch (feature_kind(code)) {
          case FeatureKind::face:
            other.corner[k] = at(wall.face_vertex[i].v[k]);
            break;
          case FeatureKind::edge:
            other.corner[k] = at(wall.edge_vertex[i].v[k % 2]);
            break;
          default:
            other.corner[k] = at(static_cast<int>(i));
        }
      if (triangles_meet(posed, other)) pairs.push_back({t, code});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::unique_ptr<BodyCollision> collision_of(const BodyGrid &grid, const TriangleSoup &body)
{
  auto c = make_body_collision(test_device());
  c->set_wall(grid);
  c->set_body(body);
  return c;
}

TriangleSoup scaled(TriangleSoup soup, Real by)
{
  for (Vec3 &p : soup.corners) p = by * p;
  return soup;
}

long quick(long full, long few)
{
  const char *asked = std::getenv("LSDCD_QUICK");
  return asked && *asked == '1' ? few : full;
}

// Meshes of all kinds of random_mesh.h, of any size beside each other and of any cell.
TEST(bodies, pairs_of_random_meshes_are_those_of_all_with_all)
{
  long pairs = 0, none = 0;
  for (long seed = 1; seed <= quick(600, 150); seed++) {
    Numbers r(1000 + seed);
    const RandomMesh wall = random_mesh(2 * seed), of_body = random_mesh(2 * seed + 1);
    const WeldedMesh mesh = weld(wall.soup, 0);
    const Real across = norm(mesh.report.hi - mesh.report.lo);
    // The body as large as the wall, or much smaller or larger.
    TriangleSoup body = of_body.soup;
    const Vec3 first = body.corners[0];
    Real size = 0;
    for (Vec3 &p : body.corners) {
      p = p - first;
      size = std::max(size, norm(p));
    }
    if (size > 0) body = scaled(body, across * r.log_in(0.02, 3) / size);
    const Real length = across * r.log_in(0.02, 1);
    const BodyGrid grid = build_grid(mesh, collision_grid(body, length));
    const auto collision = collision_of(grid, body);
    for (int pose = 0; pose < 6; pose++) {
      const Vec3 on_body = body.corners[r.below(static_cast<int>(body.corners.size()))],
                 on_wall = wall.soup.corners[r.below(static_cast<int>(wall.soup.corners.size()))];
      const Real off = r.below(3) ? 0 : across * r.log_in(1e-12, 0.3);
      BodyPose to = random_pose(r, on_body, on_wall + off * r.direction());
      if (pose == 0) {    // corner on corner, to the last digit where the body's is 0
        to = BodyPose();
        to.shift = on_wall - on_body;
      }
      const Collision found = collision->collide(to);
      const std::vector<BodyPair> expected = all_pairs(grid, body, to);
      ASSERT_EQ(found.pairs.size(), expected.size())
          << "seed " << seed << ", " << wall.kind << " and " << of_body.kind;
      EXPECT_TRUE(found.pairs == expected) << "seed " << seed;
      EXPECT_EQ(found.uncertain, 0u);
      pairs += expected.size();
      none += expected.empty();
    }
  }
  EXPECT_GT(pairs, 1000);
  EXPECT_GT(none, 10);
}

// Face 1 falls away from face 0 behind the fold y = 0. All of the cell 0.5 <= y <= 1.5 is nearer to
// face 0, so that a complete list of features leaves face 1 out, with its edges; a piece whose
// centroid is there cuts face 1 alone.
TEST(bodies, face_behind_its_neighbours_fold_is_found)
{
  const Real end = 4. / 3;    // puts that cell where it is
  TriangleSoup wall, body;
  wall.source = "fold";
  wall.corners = {{-2, 0, 0}, {4, 0, 0}, {1, 4, 0}, {4, 0, 0}, {-2, 0, 0}, {1, -end, -0.1 * end}};
  body.source = "needle";
  body.corners = {{1, 0.85, 0.4}, {1.01, 0.85, 0.4}, {1, -0.05, -0.02}};
  const WeldedMesh mesh = weld(wall, 0);
  const BodyGridSettings settings = collision_grid(body, 1);
  const BodyGrid grid = build_grid(mesh, settings);
  const Collision found = collision_of(grid, body)->collide(BodyPose());
  ASSERT_EQ(found.pairs.size(), 1u);
  EXPECT_EQ(found.pairs[0].wall, feature_code(FeatureKind::face, 1));

  StepGridSettings for_steps;
  static_cast<GridSettings &>(for_steps) = settings;
  const StepGrid of_features = build_grid(mesh, for_steps);
  const GridView view = of_features.view();
  CellAddress at;
  Cell cell;
  ASSERT_TRUE(find_cell(view, {1, 0.55, 0.26}, at, cell));
  ASSERT_EQ(cell.count, 1u);
  EXPECT_EQ(cell.first, feature_code(FeatureKind::face, 0));
}

TEST(bodies, cylinder_in_a_cylinder_touches_it_when_moved_by_the_gap)
{
  const TriangleSoup body = cylinder_mesh(16, 3, 1, 1);
  const BodyGrid grid = build_grid(weld(cylinder_mesh(16, 5, 1.5, 4), 0), collision_grid(body));
  const auto collision = collision_of(grid, body);
  BodyPose pose;
  pose.shift = {0, 0, 1.5};
  EXPECT_FALSE(collision->collide(pose).any());
  pose.shift.x = 0.5;    // 1 + 0.5: corners on corners, without rounding
  EXPECT_TRUE(collision->collide(pose).any());
  pose.shift.x = 0.4999;
  EXPECT_FALSE(collision->collide(pose).any());
  pose.shift = {0, 0, 100};
  EXPECT_FALSE(collision->collide(pose).any());
}

// A vertical triangle through a floor z = 0 cuts it along a segment that is known; the floor's
// triangles share it.
TEST(bodies, segments_are_where_the_triangles_cut)
{
  const BodyGrid grid =
      build_grid(weld(floor_mesh(4, 1), 0), collision_grid(box_mesh({0, 0, 0}, {1, 1, 1}), 0.2));
  TriangleSoup body;
  body.source = "blade";
  body.corners = {{-0.7, 0.1, -1}, {0.9, 0.1, -1}, {0.1, 0.1, 1}};
  const Collision found = collision_of(grid, body)->collide(BodyPose(), true);
  ASSERT_EQ(found.segments.size(), found.pairs.size());
  ASSERT_GT(found.pairs.size(), 2u);
  Real length = 0, lo = 1, hi = -1;
  for (const MeetingSegment &s : found.segments) {
    EXPECT_FALSE(s.flat);
    for (const Vec3 &x : {s.from, s.to}) {
      EXPECT_NEAR(x.y, 0.1, 4 * kRoundoff);    // two interpolations of numbers near 1
      EXPECT_NEAR(x.z, 0, 4 * kRoundoff);
      lo = std::min(lo, x.x);
      hi = std::max(hi, x.x);
    }
    length += norm(s.to - s.from);
  }
  // Half way up, the blade is from -0.3 to 0.5.
  EXPECT_NEAR(lo, -0.3, 8 * kRoundoff);
  EXPECT_NEAR(hi, 0.5, 8 * kRoundoff);
  EXPECT_NEAR(length, 0.8, 64 * kRoundoff);
}

TEST(bodies, triangles_in_one_plane_are_flagged)
{
  const TriangleSoup body = floor_mesh(1, 0.3);
  const BodyGrid grid = build_grid(weld(floor_mesh(2, 1), 0), collision_grid(body, 0.5));
  const Collision found = collision_of(grid, body)->collide(BodyPose(), true);
  EXPECT_GT(found.pairs.size(), 4u);
  for (const MeetingSegment &s : found.segments) EXPECT_TRUE(s.flat);
}

// One small blade through the middle of each triangle of a floor, and of each body a second time
// shifted out of it: more pairs than the 81920 that there is room for at first, then none.
TEST(bodies, many_pairs_find_room)
{
  const TriangleSoup floor = floor_mesh(220, 1);
  ASSERT_EQ(floor.n_triangles(), 96800u);
  const WeldedMesh mesh = weld(floor, 0);
  TriangleSoup body;
  body.source = "blades";
  const Real a = 1e-3;    // a fifth of the floor's legs
  for (std::size_t t = 0; t < floor.n_triangles(); t++) {
    const Vec3 *c = &floor.corners[3 * t], middle = (1. / 3) * (c[0] + c[1] + c[2]);
    for (const Vec3 &off : {Vec3{-a, 0, -a}, Vec3{a, 0, -a}, Vec3{0, 0, a}})
      body.corners.push_back(middle + off);
  }
  const BodyGrid grid = build_grid(mesh, collision_grid(body, 0.02));
  const auto collision = collision_of(grid, body);
  for (const Real up : {0., 0., 0.1}) {
    BodyPose pose;
    pose.shift.z = up;
    const Collision found = collision->collide(pose, true);
    ASSERT_EQ(found.pairs.size(), up > 0 ? 0u : 96800u);
    ASSERT_EQ(found.segments.size(), found.pairs.size());
    for (std::uint32_t t = 0; t < found.pairs.size(); t++)
      ASSERT_TRUE((found.pairs[t] == BodyPair{t, feature_code(FeatureKind::face, t)})) << t;
  }
}

// Lists of one triangle miss pairs, and say of how many pieces that may be so.
TEST(bodies, nearest_lists_find_no_pair_too_many_and_say_where_they_were_cut_short)
{
  const TriangleSoup body = cylinder_mesh(30, 9, 1, 2);
  const WeldedMesh mesh = weld(cylinder_mesh(40, 20, 1.3, 3), 0);
  const BodyGrid all = build_grid(mesh, collision_grid(body, 0.3));
  BodyPose pose;
  pose.shift = {0.4, 0.3, 1.3};
  const Collision expected = collision_of(all, body)->collide(pose);
  std::size_t before = 0;
  for (const int n : {1, 2, 4, 32}) {
    const BodyGrid grid = build_grid(mesh, collision_grid(body, 0.3, n));
    const Collision found = collision_of(grid, body)->collide(pose);
    EXPECT_TRUE(std::includes(expected.pairs.begin(), expected.pairs.end(), found.pairs.begin(),
                              found.pairs.end()));
    EXPECT_GE(found.pairs.size(), before);
    EXPECT_TRUE(found.pairs.size() == expected.pairs.size() || found.uncertain > 0);
    before = found.pairs.size();
    EXPECT_TRUE(n > 1 || found.pairs.size() < expected.pairs.size());
  }
}

// Each piece finds what its own short list has, though that of the piece before is cut short. Corners
// in another order cut a triangle into the same pieces, the last of them first, where no two edges
// have one length.
TEST(bodies, nearest_lists_find_the_same_whichever_way_a_triangle_goes_round)
{
  Numbers r(7);
  TriangleSoup body = cylinder_mesh(30, 9, 1, 2);
  for (Vec3 &x : body.corners) x += 0.02 * r.direction();
  TriangleSoup turned = body;
  for (std::size_t c = 0; c < turned.corners.size(); c += 3)
    std::swap(turned.corners[c], turned.corners[c + 1]);
  const WeldedMesh mesh = weld(cylinder_mesh(40, 20, 1.3, 3), 0);
  BodyPose pose;
  pose.shift = {0.4, 0.3, 1.3};
  for (const int n : {1, 2, 4}) {
    const BodyGrid grid = build_grid(mesh, collision_grid(body, 0.1, n));
    const Collision found = collision_of(grid, body)->collide(pose);
    EXPECT_GT(found.pairs.size(), 10u) << n;
    EXPECT_TRUE(found.pairs == collision_of(grid, turned)->collide(pose).pairs) << n;
  }
}

TEST(bodies, wrong_use_is_an_error)
{
  const TriangleSoup body = box_mesh({0, 0, 0}, {1, 1, 1});
  const WeldedMesh mesh = weld(body, 0);
  auto collision = make_body_collision(test_device());
  EXPECT_THROW(collision->set_body(body), InputError);
  EXPECT_THROW(collision->collide(BodyPose()), InputError);
  collision->set_wall(build_grid(mesh, collision_grid(body, 0.1)));
  EXPECT_THROW(collision->set_body(TriangleSoup()), InputError);
  EXPECT_THROW(collision->set_body(scaled(body, 1e5)), InputError);
  TriangleSoup no_number = body;
  no_number.corners[4].y = std::nan("");
  EXPECT_THROW(collision->set_body(no_number), InputError);
  EXPECT_THROW(collision->collide(BodyPose()), InputError);
  collision->set_body(body);
  BodyPose pose;
  pose.row[0] = {1.001, 0, 0};
  EXPECT_THROW(collision->collide(pose), InputError);
  pose.row[0] = {-1, 0, 0};
  EXPECT_THROW(collision->collide(pose), InputError);
  pose = BodyPose();
  pose.shift.x = 1e12;
  EXPECT_THROW(collision->collide(pose), InputError);
}

}    // namespace
}    // namespace lsdcd::test_bodies
