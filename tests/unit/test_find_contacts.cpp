// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Merging closest points at one point, and keeping to one side of a closed wall.
#include "contact/find_contacts.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

namespace lsdcd::test_find_contacts {
namespace {

// ---- add_once --------------------------------------------------------------------------

constexpr Real kTolerance = 1e-12;
const Vec3 kUp = {0, 0, 1};

ContactSet<8> added(const std::vector<std::pair<FeatureCode, ClosestPoint>> &feet)
{
  ContactSet<8> set;
  for (const auto &f : feet) add_once(set, f.first, f.second, kTolerance);
  return set;
}

// The closest point at x (length) beside the point below the centre, one away from it.
ClosestPoint foot_beside(Real x)
{
  const Vec3 d = {-x, 0, 1};
  return {true, norm(d), (1 / norm(d)) * d};
}

TEST(add_once, takes_feet_within_four_slacks_for_one)
{
  EXPECT_EQ(added({{1, foot_beside(0)}, {2, foot_beside(3.9 * kTolerance)}}).n, 1);
  EXPECT_EQ(added({{1, foot_beside(0)}, {2, foot_beside(4.1 * kTolerance)}}).n, 2);
}

TEST(add_once, keeps_the_lower_feature_whatever_the_order)
{
  const ClosestPoint f = {true, 0.5, kUp};
  EXPECT_EQ(added({{7, f}, {3, f}, {5, f}}).feature[0], 3u);
  EXPECT_EQ(added({{3, f}, {5, f}, {7, f}}).feature[0], 3u);
  EXPECT_EQ(added({{5, f}, {7, f}, {3, f}}).n, 1);
}

TEST(add_once, keeps_the_nearer_foot_whatever_the_order)
{
  const ClosestPoint near = {true, 0.5, kUp}, far = {true, 0.5 + kTolerance, kUp};
  for (const auto &set : {added({{1, far}, {2, near}}), added({{2, near}, {1, far}})}) {
    EXPECT_EQ(set.n, 1);
    EXPECT_EQ(set.feature[0], 2u);
    EXPECT_EQ(set.distance[0], 0.5);
  }
}

TEST(add_once, keeps_walls_on_opposite_sides_apart)
{
  EXPECT_EQ(added({{1, {true, 0.5, kUp}}, {2, {true, 0.5, -kUp}}}).n, 2);
}

// ---- filter_side -------------------------------------------------------------------------

struct Given {
  FeatureCode feature;
  Vec3 normal;
  Real distance;
};

// The contacts by the rule, one by one.
std::map<FeatureCode, Given> expected_side(const std::vector<FaceRecord> &faces, Real sign,
                                           const std::vector<Given> &given)
{
  std::map<FeatureCode, Given> out;
  const auto nearest =
      std::min_element(given.begin(), given.end(),
                       [](const Given &a, const Given &b) { return a.distance < b.distance; });
  for (const Given &g : given) {
    const bool right = sign * dot(faces[g.feature].normal, g.normal) >= 0;
    if (right)
      out[g.feature] = g;
    else if (g.feature == nearest->feature)
      out[g.feature] = {g.feature, -g.normal, -g.distance};
  }
  return out;
}

TEST(filter_side, turns_the_nearest_contact_and_drops_the_others_on_the_wrong_side)
{
  Random random(1);
  for (int k = 0; k < 20000; k++) {
    const int n = 1 + static_cast<int>(random() % 8);
    std::vector<FaceRecord> faces(n, FaceRecord{});
    std::vector<Given> given;
    ContactSet<8> set;
    for (int i = 0; i < n; i++) {
      faces[i].normal = random_unit(random);
      const Given g = {static_cast<FeatureCode>(i), random_unit(random),
                       std::uniform_real_distribution<Real>(0, 1)(random)};
      given.push_back(g);
      set.add(g.feature, g.normal, g.distance);
    }
    MeshFeaturesView wall = {};
    wall.faces = faces.data();
    const Real sign = random() % 2 ? 1 : -1;
    const auto expected = expected_side(faces, sign, given);
    filter_side(wall, sign, set);
    ASSERT_EQ(set.n, static_cast<int>(expected.size()));
    for (int i = 0; i < set.n; i++) {
      const auto e = expected.find(set.feature[i]);
      ASSERT_NE(e, expected.end());
      ASSERT_EQ(set.normal[i], e->second.normal);
      ASSERT_EQ(set.distance[i], e->second.distance);
    }
  }
}

}    // namespace
}    // namespace lsdcd::test_find_contacts
