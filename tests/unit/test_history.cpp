// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How springs are handed on from one step's contacts to the next's.
#include "contact/history.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

ContactSet<8> contacts(std::initializer_list<std::pair<FeatureCode, Vec3>> list)
{
  ContactSet<8> set;
  for (const auto &c : list) set.add(c.first, c.second, 0.9);
  return set;
}

const Vec3 kUp = {0, 0, 1}, kShear = {0.01, -0.02, 0};

// The shear displacement with which contact i begins.
Vec3 transferred_shear(const MeshFeaturesView &wall, const ContactSet<8> &set, int i,
                       const Spring *old, int n_old)
{
  const Transfer in = lsdcd::transfer_of(wall, set.view(), i, old, n_old);
  return in.from < 0 ? Vec3{0, 0, 0} : handed_on(old[in.from].shear, in, old, set.normal[i]);
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

// A sphere had one spring, on kHere.
class transfer_of : public testing::Test {
 protected:
  const Cube cube;
  const Spring old = {kShear, kUp, kHere, 0};
  const FeatureCode v =
      feature_code(FeatureKind::vertex, cube.f.face_vertex[0].v[1]);    // of kHere
};

TEST_F(transfer_of, without_old_springs_starts_at_zero)
{
  const Vec3 h = transferred_shear(cube.view, contacts({{kHere, kUp}}), 0, nullptr, 0);
  EXPECT_EQ(h, (Vec3{0, 0, 0}));
}

TEST_F(transfer_of, of_the_same_feature_is_the_whole_spring)
{
  EXPECT_EQ(transferred_shear(cube.view, contacts({{kHere, kUp}}), 0, &old, 1), kShear);
}

TEST_F(transfer_of, of_the_same_feature_turns_with_the_normal)
{
  const Vec3 n = leaning(40);
  const Vec3 h = transferred_shear(cube.view, contacts({{kHere, n}}), 0, &old, 1);
  EXPECT_NEAR(norm(h), norm(kShear), 1e-16);
  EXPECT_NEAR(dot(h, n), 0, 1e-17);
  EXPECT_EQ(h.y, kShear.y);
}

TEST_F(transfer_of, of_the_same_feature_goes_before_a_better_aligned_one)
{
  const Spring both[2] = {{{1, 0, 0}, kUp, kNext, 0}, {kShear, leaning(30), kHere, 0}};
  const Vec3 h = transferred_shear(cube.view, contacts({{kHere, kUp}}), 0, both, 2);
  EXPECT_NEAR(norm(h), norm(kShear), 1e-16);
}

TEST_F(transfer_of, of_the_same_feature_ends_where_the_centre_crossed_to_the_other_side)
{
  EXPECT_EQ(transferred_shear(cube.view, contacts({{kHere, -kUp}}), 0, &old, 1), (Vec3{0, 0, 0}));
}

TEST_F(transfer_of, across_a_seam_is_the_whole_spring)
{
  // Aligned or leaning, the length stays: the contact moved, it was not born.
  for (Real degrees : {0., 1e-3, 10., 40.}) {
    const Vec3 h = transferred_shear(cube.view, contacts({{kNext, leaning(degrees)}}), 0, &old, 1);
    EXPECT_NEAR(norm(h), norm(kShear), 1e-16) << degrees;
  }
}

TEST_F(transfer_of, across_a_seam_to_the_next_feature_changes_no_bit_on_a_plane)
{
  EXPECT_EQ(transferred_shear(cube.view, contacts({{kNext, kUp}}), 0, &old, 1), kShear);
}

TEST_F(transfer_of, of_a_contact_born_beside_one_that_stays_is_the_cosine_of_its_spring)
{
  for (Real degrees : {0., 20., 44., 46., 60., 89.}) {
    const Vec3 n = leaning(degrees);
    const Vec3 h = transferred_shear(cube.view, contacts({{kHere, kUp}, {kNext, n}}), 1, &old, 1);
    EXPECT_NEAR(norm(h), std::cos(degrees * kPi / 180) * norm(kShear), 1e-16) << degrees;
    EXPECT_NEAR(dot(h, n), 0, 1e-17);
  }
}

// A plane that is cut in two between kHere and kNext: the sphere crosses the cut while a contact begins at a vertex
// of kHere.
TEST_F(transfer_of, of_a_contact_born_while_the_old_one_crosses_a_cut_is_the_cosine_of_its_spring)
{
  const Vec3 h =
      transferred_shear(cube.view, contacts({{kNext, kUp}, {v, leaning(30)}}), 1, &old, 1);
  EXPECT_NEAR(norm(h), std::cos(30 * kPi / 180) * norm(kShear), 1e-16);
}

TEST_F(transfer_of, across_a_cut_is_the_whole_spring_where_another_contact_is_born)
{
  EXPECT_EQ(transferred_shear(cube.view, contacts({{kNext, kUp}, {v, leaning(30)}}), 0, &old, 1),
            kShear);
}

// Two sheets in one place: the sphere crosses the same line of both, and neither may take the hold from the other.
TEST_F(transfer_of, holds_what_goes_on_across_a_cut_where_two_contacts_lie_in_its_direction)
{
  const ContactSet<8> set = contacts({{kNext, kUp}, {v, kUp}});
  for (int i = 0; i < 2; i++) EXPECT_TRUE(is_held(cube.view, set.view(), i, false, &old, 1)) << i;
}

TEST_F(transfer_of, in_a_right_angled_corner_is_nothing)
{
  const Vec3 across = {1, 0, 0}, under = {0.6, 0, -0.8};
  for (const Vec3 &n : {across, under})
    EXPECT_EQ(transferred_shear(cube.view, contacts({{kHere, kUp}, {kNext, n}}), 1, &old, 1),
              (Vec3{0, 0, 0}));
}

TEST_F(transfer_of, from_a_feature_far_away_is_the_cosine_of_its_spring)
{
  const Spring far = {kShear, kUp, kFar, 0};
  const Vec3 h = transferred_shear(cube.view, contacts({{kHere, leaning(20)}}), 0, &far, 1);
  EXPECT_NEAR(norm(h), std::cos(20 * kPi / 180) * norm(kShear), 1e-16);
}

TEST_F(transfer_of, takes_the_best_aligned_spring)
{
  const Spring three[3] = {{{1, 0, 0}, leaning(50), kFar, 0},
                           {kShear, leaning(10), kFar + 1, 0},
                           {{2, 0, 0}, leaning(-30), kFar, 0}};
  const Vec3 h = transferred_shear(cube.view, contacts({{kHere, kUp}}), 0, three, 3);
  EXPECT_NEAR(norm(h), std::cos(10 * kPi / 180) * norm(kShear), 1e-16);
}

}    // namespace
}    // namespace lsdcd::test_history
