// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How springs are handed on from one step's contacts to the next's.
#include "contact/feature_turn.h"
#include "contact/grain_contacts.h"
#include "contact/history.h"
#include "engine/step/contact_energy.h"
#include "law/smallest_model.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace lsdcd::test_history {
namespace {

Vec3 tangent_to(const Vec3 &n, Random &random)
{
  const Vec3 t = cross(n, random_unit(random));
  return (0.01 / norm(t)) * t;
}

// ---- transport -------------------------------------------------------------------------

TEST(transport, keeps_length_and_tangency)
{
  Random random(1);
  for (int i = 0; i < 10000; i++) {
    const Vec3 from = random_unit(random), to = random_unit(random);
    const Real c = dot(from, to);
    if (c < -0.9) continue;
    const Vec3 h = tangent_to(from, random), turned = transport(h, from, to);
    // Ten roundings, and the division by 1 + cos.
    const Real tolerance = 0.01 * 16 * kRoundoff / (1 + c);
    ASSERT_NEAR(norm(turned), norm(h), tolerance);
    ASSERT_NEAR(dot(turned, to), 0, tolerance);
  }
}

TEST(transport, turns_no_more_than_the_normal)
{
  Random random(2);
  for (int i = 0; i < 1000; i++) {
    const Vec3 from = random_unit(random), h = tangent_to(from, random);
    const Vec3 n = from + 1e-3 * random_unit(random), to = (1 / norm(n)) * n;
    ASSERT_LE(norm(transport(h, from, to) - h), norm(h) * norm(to - from) * (1 + 1e-6));
    // Along the axis of the rotation nothing moves.
    const Vec3 axis = cross(from, to);
    ASSERT_LE(norm(transport(axis, from, to) - axis), 1e-12 * norm(axis));
  }
}

TEST(transport, to_an_equal_normal_changes_no_bit)
{
  Random random(3);
  for (int i = 0; i < 1000; i++) {
    const Vec3 n = random_unit(random), h = tangent_to(n, random);
    ASSERT_EQ(transport(h, n, n), h);
  }
}

TEST(transport, quarter_turn_takes_the_old_normal_to_the_opposite_side)
{
  const Vec3 h = transport({1, 0, 0}, {0, 0, 1}, {1, 0, 0});
  EXPECT_EQ(h, (Vec3{0, 0, -1}));
}

// From x to y: all turns about z by a right angle.
TEST(turn_with_feature, is_the_smallest_turn_of_an_edge_that_no_face_has)
{
  const int edges[] = {0, 1}, edge_first[] = {0, 0};
  MeshTopologyView mesh = {};
  mesh.edges = edges;
  mesh.edge_first = edge_first;
  mesh.n_edges = 1;
  mesh.n_vertices = 2;
  const Vec3 from[] = {{1, 0, 0}, {3, 0, 0}}, to[] = {{0, 5, 0}, {0, 6, 0}};
  Spring spring = {{1, 2, 3}, {0, 0.6, 0.8}, feature_code(FeatureKind::edge, 0), 0};
  Vec3 beside = {4, 5, 6};
  turn_with_feature({mesh, nullptr, from, to}, spring, &beside, 1);
  const Real tolerance = 8 * 16 * kRoundoff;    // of numbers up to 6, as above
  EXPECT_LT(norm(spring.normal - Vec3{-0.6, 0, 0.8}), tolerance);
  EXPECT_LT(norm(spring.shear - Vec3{-2, 1, 3}), tolerance);
  EXPECT_LT(norm(beside - Vec3{-5, 4, 6}), tolerance);
}

// A line has no sense: where the ends of an edge have changed places in a step, no smallest turn of its direction is the one.
TEST(turn_with_feature, leaves_what_is_on_an_edge_whose_ends_change_places)
{
  const int edges[] = {0, 1}, edge_first[] = {0, 0};
  MeshTopologyView mesh = {};
  mesh.edges = edges;
  mesh.edge_first = edge_first;
  mesh.n_edges = 1;
  mesh.n_vertices = 2;
  for (const Real off : {0., 1e-12}) {
    const Vec3 from[] = {{1, 0, 0}, {3, 0, 0}}, to[] = {{3, 0, off}, {1, 0, 0}};
    Spring spring = {{1, 2, 3}, {0, 0.6, 0.8}, feature_code(FeatureKind::edge, 0), 0};
    Vec3 beside = {4, 5, 6};
    turn_with_feature({mesh, nullptr, from, to}, spring, &beside, 1);
    // The line has turned by off/2, and vectors up to 9 long by as much.
    const Real tolerance = 9 * off + 8 * 16 * kRoundoff;
    EXPECT_LT(norm(spring.normal - Vec3{0, 0.6, 0.8}), tolerance) << off;
    EXPECT_LT(norm(spring.shear - Vec3{1, 2, 3}), tolerance) << off;
    EXPECT_LT(norm(beside - Vec3{4, 5, 6}), tolerance) << off;
  }
}

TEST(transport, leaves_nothing_of_a_vector_whose_normal_has_turned_round)
{
  const Vec3 h = {0.1, 0.2, 0}, up = {0, 0, 1};
  for (const Vec3 &to : {Vec3{0, 0, -1}, Vec3{1e-9, 0, -1}, Vec3{0.6, 0, -0.8}})
    EXPECT_EQ(transport_unless_turned_round(h, up, to), (Vec3{0, 0, 0}));
  EXPECT_EQ(transport_unless_turned_round(h, up, {0.8, 0, -0.6}), transport(h, up, {0.8, 0, -0.6}));
}

// ---- the three rules -------------------------------------------------------------------

// A cube: faces 0 and 1 make its bottom, and so on; all of it adjacent in pairs.
struct Cube {
  WeldedMesh mesh = weld(box_mesh({0, 0, 0}, {1, 1, 1}), 0);
  MeshFeatures f = make_features(mesh, false);
  MeshFeaturesView view = f.view();
};

Vec3 leaning(Real degrees)
{
  const Real a = degrees * kPi / 180;
  return {std::sin(a), 0, std::cos(a)};
}

// Adjacent and not: bottom's first triangle with the top's, or with its twin.
constexpr FeatureCode kHere = 0, kNext = 1, kFar = 2;

ContactSet<8> contacts(const std::vector<std::pair<FeatureCode, Vec3>> &list)
{
  ContactSet<8> set;
  for (const auto &c : list) set.add(c.first, c.second, 0.9);
  return set;
}

const Vec3 kUp = {0, 0, 1}, kShear = {0.01, -0.02, 0};

// The shear displacement with which contact i begins.
Vec3 transferred_shear(const MeshFeaturesView &wall, const ContactSet<8> &set, int i,
                       const std::vector<Spring> &old)
{
  const int n = static_cast<int>(old.size());
  const Transfer in = transfer_of(wall, set.view(), i, old.data(), n);
  return in.from < 0 ? Vec3{0, 0, 0} : handed_on(old[in.from].shear, in, old.data(), set.normal[i]);
}

TEST(features, of_a_cube_are_adjacent_where_they_share_a_vertex)
{
  const Cube cube;
  EXPECT_TRUE(are_adjacent(cube.view, kHere, kNext));
  EXPECT_FALSE(are_adjacent(cube.view, kHere, kFar));
  const FeatureCode v = feature_code(FeatureKind::vertex, cube.f.face_vertex[0].v[1]);
  EXPECT_TRUE(are_adjacent(cube.view, kHere, v));
  EXPECT_FALSE(are_adjacent(cube.view, kFar, v));
  const FeatureCode e = feature_code(FeatureKind::edge, cube.mesh.face_edges[0][0]);
  EXPECT_TRUE(are_adjacent(cube.view, kHere, e));
  EXPECT_TRUE(are_adjacent(cube.view, v, e));
  EXPECT_FALSE(are_adjacent(cube.view, kFar, e));
}

TEST(transfer_of, is_the_whole_spring_where_a_contact_goes_on_and_its_cosine_where_one_is_born)
{
  const Cube cube;
  const FeatureCode v =
      feature_code(FeatureKind::vertex, cube.f.face_vertex[0].v[1]);    // of kHere
  const auto cosine = [](Real degrees) { return std::cos(degrees * kPi / 180); };
  const std::vector<Spring> old = {{kShear, kUp, kHere, 0}};
  struct Row {
    const char *what;
    std::vector<std::pair<FeatureCode, Vec3>> contacts;
    int i;    // of the contact
    std::vector<Spring> springs;
    Real share;    // of the spring, which is turned with the normal
  };
  // A plane that is cut in two between kHere and kNext: the sphere crosses the cut while a contact begins at v.
  const std::vector<std::pair<FeatureCode, Vec3>> cut = {{kNext, kUp}, {v, leaning(30)}};
  std::vector<Row> rows = {
      {"no springs", {{kHere, kUp}}, 0, {}, 0},
      {"the same feature", {{kHere, kUp}}, 0, old, 1},
      {"the same feature, turned", {{kHere, leaning(40)}}, 0, old, 1},
      {"the same feature before a better aligned one",
       {{kHere, kUp}},
       0,
       {{{1, 0, 0}, kUp, kNext, 0}, {kShear, leaning(30), kHere, 0}},
       1},
      {"the same feature, whose other side the centre is on", {{kHere, -kUp}}, 0, old, 0},
      {"born where the old one crosses a cut", cut, 1, old, cosine(30)},
      {"across a cut where another one is born", cut, 0, old, 1},
      {"in a right-angled corner", {{kHere, kUp}, {kNext, {1, 0, 0}}}, 1, old, 0},
      {"under it", {{kHere, kUp}, {kNext, {0.6, 0, -0.8}}}, 1, old, 0},
      {"from a feature far away", {{kHere, leaning(20)}}, 0, {{kShear, kUp, kFar, 0}}, cosine(20)},
      {"the best aligned spring",
       {{kHere, kUp}},
       0,
       {{{1, 0, 0}, leaning(50), kFar, 0},
        {kShear, leaning(10), kFar + 1, 0},
        {{2, 0, 0}, leaning(-30), kFar, 0}},
       cosine(10)}};
  // Aligned or leaning, across a seam the length stays: the contact moved, it was not born.
  for (Real degrees : {0., 1e-3, 10., 40.})
    rows.push_back({"across a seam", {{kNext, leaning(degrees)}}, 0, old, 1});
  for (Real degrees : {0., 20., 44., 46., 60., 89.})
    rows.push_back({"born beside one that stays",
                    {{kHere, kUp}, {kNext, leaning(degrees)}},
                    1,
                    old,
                    cosine(degrees)});
  for (const Row &row : rows) {
    const ContactSet<8> set = contacts(row.contacts);
    const Vec3 h = transferred_shear(cube.view, set, row.i, row.springs), n = set.normal[row.i];
    EXPECT_NEAR(norm(h), row.share * norm(kShear), 1e-16) << row.what;
    EXPECT_NEAR(h.y, row.share * kShear.y, 1e-17) << row.what;    // no normal leans in y
    if (row.share == 0) {
      EXPECT_EQ(h, (Vec3{0, 0, 0})) << row.what;
    }
    if (row.springs.size() == 1) {
      EXPECT_NEAR(dot(h, n), 0, 1e-17) << row.what;
    }
    if (row.share == 1 && n == row.springs.back().normal) {
      EXPECT_EQ(h, kShear) << row.what;
    }
  }
}

// A rod that lies along x, and turns about y, touches with both ends: below on the left, and above on the right. Both contacts turn it
// alike, so that they are alike by more than half, and yet push it in opposite directions, or at more than a right angle.
TEST(transfer_of, hands_nothing_on_between_arms_whose_normals_point_apart)
{
  const Cube cube;
  const Real about_y = 1.04 / 5;    // inertia over mass of the half-axes 1, 0.2, 0.2
  const GrainMetric metric = {
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      {std::sqrt(5 / 0.08), std::sqrt(1 / about_y), std::sqrt(1 / about_y)}};
  const Spring spring = {kShear, kUp, kHere, 0};
  const Spring *const old = &spring;
  const Real arm[] = {-0.9, 0, -0.1};
  const OldGrainContacts<const Spring *> with_arms = {old, arm, 3, metric};
  const auto taken = [&](const Vec3 &normal, const Vec3 &at) {
    const GrainContact contact = {kFar,   normal, 0.01, at, at, metric.direction(normal, at),
                                  &metric};
    const GrainContactsView set = {1, &contact, nullptr};
    const Real alike = dot(contact.direction, old_direction(with_arms, 0));
    EXPECT_GT(alike, 0.5);
    const Transfer in = transfer_of(cube.view, set, 0, with_arms, 1);
    if (in.from == 0) {
      EXPECT_EQ(in.part, alike);
    }
    return in.from;
  };
  for (const Real degrees : {95., 120., 179., 180 - 1e-7, 180.}) {
    const Real a = degrees * kPi / 180;
    // The arm is where it turns the rod about y: across the normal, which leans in x.
    const Vec3 normal = {std::sin(a), 0, std::cos(a)};
    EXPECT_EQ(taken(normal, 0.9 * Vec3{-std::cos(a), 0, std::sin(a)}), -1) << degrees;
  }
  EXPECT_EQ(taken(leaning(60), 0.9 * Vec3{-0.5, 0, 0.8}), 0);
}

// Two sheets in one place: the sphere crosses the same line of both, and neither may take the hold from the other.
// A contact that is born beside others takes a part of their spring, and of the forces by which books know what it holds.
TEST(transfer_of, hands_on_all_forces_of_a_spring_by_the_same_part)
{
  using Model = GranularModel<TouchingNormal, true, GranularSet::all>;
  const OnWall<Model, true, true, false, true> law = {
      granular_model<true, GranularSet::all>(granular_law(NormalModel::hooke),
                                             TouchingNormal{NormalModel::hooke, 1, 0}),
      {},
      {}};
  KeptForces kept = {};
  kept.friction = {1, 2, 0};
  kept.friction_spring = {3, -1, 0};
  kept.rolling = {0, 5, 0};
  kept.rolling_spring = {-4, 2, 0};
  kept.twisting = 7;
  kept.twisting_spring = -6;
  kept.k_friction = 10;
  kept.k_rolling = 20;
  kept.k_twisting = 30;
  ASSERT_EQ(n_extra(law), 0);    // its numbers are those of the books alone
  Spring spring = {};
  spring.normal = {0, 0, 1};
  SphereState s = {};
  s.springs = &spring;
  s.extra = &kept.held;
  s.n_springs = 1;
  const Real part = 0.25;
  const KeptForces now = EnergyBook<std::decay_t<decltype(law)>>::handed_on(
      law, ForceSettings(), s, Transfer{0, part}, spring.normal);
  EXPECT_EQ(now.friction, part * kept.friction);
  EXPECT_EQ(now.friction_spring, part * kept.friction_spring);
  EXPECT_EQ(now.rolling, part * kept.rolling);
  EXPECT_EQ(now.rolling_spring, part * kept.rolling_spring);
  EXPECT_EQ(now.twisting, part * kept.twisting);
  EXPECT_EQ(now.twisting_spring, part * kept.twisting_spring);
  EXPECT_EQ(now.k_friction, kept.k_friction);
  EXPECT_EQ(now.k_rolling, kept.k_rolling);
  EXPECT_EQ(now.k_twisting, kept.k_twisting);
}

TEST(is_held, goes_on_across_a_cut_where_two_contacts_lie_in_its_direction)
{
  const Cube cube;
  const Spring old = {kShear, kUp, kHere, 0};
  const FeatureCode v = feature_code(FeatureKind::vertex, cube.f.face_vertex[0].v[1]);
  const ContactSet<8> set = contacts({{kNext, kUp}, {v, kUp}});
  for (int i = 0; i < 2; i++) EXPECT_TRUE(is_held(cube.view, set.view(), i, false, &old, 1)) << i;
}

}    // namespace
}    // namespace lsdcd::test_history
