// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contacts of grains that are no spheres, in lists of features that were made at other places: what else is listed changes no
// bit, so that a run goes on as before however old its lists are.
#include "contact/shape_search.h"
#include "support/cut_surface.h"
#include "support/random.h"
#include "support/tree_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace lsdcd::test_near_features {
namespace {

// A square of 2 n^2 triangles whose corners are at random heights.
TriangleSoup rough_ground(Random &random, int n, Real roughness)
{
  std::normal_distribution<Real> normal;
  std::vector<Vec3> at;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++)
      at.push_back({11.0 * i / n - 5.5, 11.0 * j / n - 5.5, roughness * normal(random)});
  TriangleSoup soup;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const Vec3 *corner = at.data() + j * (n + 1) + i;
      soup.corners.insert(soup.corners.end(), {corner[0], corner[1], corner[n + 1]});
      soup.corners.insert(soup.corners.end(), {corner[1], corner[n + 2], corner[n + 1]});
    }
  return soup;
}

// `exponent`: 2, an ellipsoid, or more.
PlacedGrain random_grain(Random &random, Real exponent)
{
  const Vec3 half = uniform(random, {0.2, 0.2, 0.2}, {0.8, 0.8, 0.8});
  std::normal_distribution<Real> normal;
  const Quaternion turn =
      normalised({normal(random), {normal(random), normal(random), normal(random)}});
  PlacedGrain grain = {make_superellipsoid(half, exponent, exponent),
                       uniform(random, {-4.5, -4.5, -0.3}, {4.5, 4.5, 1}),
                       {}};
  const Vec3 axis[3] = {rotate(turn, {1, 0, 0}), rotate(turn, {0, 1, 0}), rotate(turn, {0, 0, 1})};
  for (int j = 0; j < 3; j++) grain.row[j] = {axis[0][j], axis[1][j], axis[2][j]};
  return grain;
}

bool are_same_bits(const std::vector<FoundGrainContact> &a, const std::vector<FoundGrainContact> &b)
{
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); i++)
    if (a[i].feature != b[i].feature || std::memcmp(&a[i].point, &b[i].point, sizeof(Vec3)) != 0 ||
        std::memcmp(&a[i].normal, &b[i].normal, sizeof(Vec3)) != 0 ||
        std::memcmp(&a[i].of_grain, &b[i].of_grain, sizeof(Vec3)) != 0 ||
        std::memcmp(&a[i].distance, &b[i].distance, sizeof(Real)) != 0)
      return false;
  return true;
}

void expect_no_bit_differs(const TriangleSoup &surface, Real exponent, int n_grains)
{
  Random random(5);
  const TreeCase at(surface);
  ShapeSearch search(at.tree);
  int n_differ = 0;
  std::size_t n_contacts = 0;
  for (int i = 0; i < n_grains; i++) {
    const PlacedGrain grain = random_grain(random, exponent);
    std::vector<FoundGrainContact> exactly, by_list;
    search.contacts(grain, exactly);
    n_contacts += exactly.size();
    for (Real reach : {1.2, 1.2, 2.5}) {
      PlacedGrain before = grain;
      const Real way = (reach - 1) * grain.shape.farthest / std::sqrt(3);
      before.centre += uniform(random, {-way, -way, -way}, {way, way, way});
      NearFeatures near;
      search.find_near(before, reach * grain.shape.farthest, near);
      by_list.clear();
      search.contacts(grain, near, by_list);
      n_differ += !are_same_bits(exactly, by_list);
    }
  }
  EXPECT_GT(n_contacts, std::size_t(n_grains) / 10);
  EXPECT_EQ(n_differ, 0);
}

}    // namespace
TEST(near_features, give_the_same_bits_on_rough_ground_whatever_else_is_listed)
{
  Random random(11);
  const TriangleSoup coarse = rough_ground(random, 14, 0.35), fine = rough_ground(random, 40, 0.1);
  expect_no_bit_differs(coarse, 2, 600);
  expect_no_bit_differs(coarse, 6, 30);
  expect_no_bit_differs(fine, 2, 60);
}
TEST(near_features, give_the_same_bits_in_folds_of_many_triangles_whatever_else_is_listed)
{
  for (Real degrees : {-60, 0, 60}) {
    expect_no_bit_differs(cut(fold(degrees), 20), 2, 100);
    expect_no_bit_differs(cut(fold(degrees), 20), 6, 20);
  }
}

}    // namespace lsdcd::test_near_features
