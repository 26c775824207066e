// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of triangles of which one sees whether they meet: touching, in one plane, without an area,
// a last digit apart, of any size. tests/unit/test_triangles_cgal.cpp has random ones.
#include "geometry/triangles_meet.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_triangles {
namespace {

const Triangle kFlat = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};

// In any order of the two and of their corners, at any scale by a power of two, exact.
bool meet(const Triangle &a, const Triangle &b)
{
  int yes = 0, no = 0;
  for (const int power : {0, -200, 200, -330, 330})
    for (int order = 0; order < 36; order++) {
      const auto turned = [&](const Triangle &t, int n) {
        const int i = n % 3, j = (i + 1 + n / 3) % 3, k = 3 - i - j;
        Triangle out = {{t[i], t[j], t[k]}};
        for (Vec3 &x : out.corner)
          x = {std::ldexp(x.x, power), std::ldexp(x.y, power), std::ldexp(x.z, power)};
        return out;
      };
      const Triangle s = turned(a, order % 6), t = turned(b, order / 6);
      yes += triangles_meet(s, t) + triangles_meet(t, s);
      no += !triangles_meet(s, t) + !triangles_meet(t, s);
    }
  EXPECT_TRUE(yes == 0 || no == 0) << yes << " of " << yes + no;
  return yes > 0;
}
TEST(triangles, meet_where_one_goes_through_the_other_or_touches_it)
{
  const struct {
    const char *what;
    Triangle other;
    bool meets;
  } rows[] = {{"through it", {{{1, 1, -1}, {1, 1, 1}, {1, 2, 1}}}, true},
              {"through the plane beside it", {{{3, 3, -1}, {3, 3, 1}, {3, 4, 1}}}, false},
              {"a corner on the face", {{{1, 1, 0}, {1, 2, 1}, {2, 1, 1}}}, true},
              {"a corner on a side", {{{2, 2, 0}, {4, 5, 1}, {5, 4, 1}}}, true},
              {"a corner on a corner", {{{4, 0, 0}, {5, 0, 1}, {5, 1, 1}}}, true},
              {"sides that cross", {{{2, 0, 1}, {2, 0, -1}, {2, -1, 0}}}, true},
              {"a side in common", {{{0, 0, 0}, {4, 0, 0}, {1, -1, 3}}}, true}};
  for (const auto &row : rows) EXPECT_EQ(meet(kFlat, row.other), row.meets) << row.what;
}
TEST(triangles, one_digit_decides)
{
  const Real above = std::nextafter(1., 2.), below = std::nextafter(1., 0.);
  const Triangle at_one = {{{0, 0, 1}, {4, 0, 1}, {0, 4, 1}}};
  EXPECT_TRUE(meet(at_one, {{{1, 1, 1}, {1, 2, 2}, {2, 1, 2}}}));
  EXPECT_FALSE(meet(at_one, {{{1, 1, above}, {1, 2, 2}, {2, 1, 2}}}));
  EXPECT_TRUE(meet(at_one, {{{1, 1, below}, {1, 2, 2}, {2, 1, 2}}}));
  // On the side x + y = 4, and one digit past it.
  EXPECT_TRUE(meet(at_one, {{{3, 1, 1}, {4, 2, 2}, {5, 1, 2}}}));
  EXPECT_FALSE(meet(at_one, {{{3, above, 1}, {4, 2, 2}, {5, 1, 2}}}));
}
TEST(triangles, in_one_plane_they_meet_where_they_overlap)
{
  EXPECT_TRUE(meet(kFlat, {{{1, 1, 0}, {9, 1, 0}, {9, 2, 0}}}));        // sides cross
  EXPECT_TRUE(meet(kFlat, {{{1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}}}));    // inside
  EXPECT_TRUE(meet(kFlat, kFlat));                                      // the same
  EXPECT_TRUE(meet(kFlat, {{{4, 0, 0}, {9, 0, 0}, {9, 1, 0}}}));        // a corner
  EXPECT_TRUE(meet(kFlat, {{{1, 0, 0}, {9, 0, 0}, {5, -1, 0}}}));       // part of a side
  EXPECT_FALSE(meet(kFlat, {{{3, 3, 0}, {4, 3, 0}, {3, 4, 0}}}));       // boxes overlap
  EXPECT_FALSE(meet(kFlat, {{{5, 0, 0}, {9, 0, 0}, {9, 1, 0}}}));
}
TEST(triangles, segment_meets_what_it_goes_through_touches_or_lies_in)
{
  const auto segment = [](const Vec3 &a, const Vec3 &b) { return Triangle{{a, 0.5 * (a + b), b}}; };
  EXPECT_TRUE(meet(kFlat, segment({1, 1, -1}, {1, 1, 1})));
  EXPECT_FALSE(meet(kFlat, segment({3, 3, -1}, {3, 3, 1})));
  EXPECT_TRUE(meet(kFlat, segment({1, 1, 0}, {1, 1, 1})));
  EXPECT_TRUE(meet(kFlat, segment({-1, 1, 0}, {9, 1, 0})));
  EXPECT_FALSE(meet(kFlat, segment({-1, 9, 0}, {9, 9, 0})));
  EXPECT_TRUE(meet(segment({0, 0, 0}, {2, 2, 2}), segment({0, 2, 2}, {2, 0, 0})));
  EXPECT_FALSE(meet(segment({0, 0, 0}, {2, 2, 2}), segment({0, 2, 0}, {2, 0, 0})));
  EXPECT_TRUE(meet(segment({0, 0, 0}, {2, 2, 2}), segment({1, 1, 1}, {4, 4, 4})));
  EXPECT_FALSE(meet(segment({0, 0, 0}, {2, 2, 2}), segment({3, 3, 3}, {4, 4, 4})));
}
TEST(triangles, point_meets_what_it_is_on)
{
  const auto point = [](const Vec3 &a) { return Triangle{{a, a, a}}; };
  EXPECT_TRUE(meet(kFlat, point({1, 1, 0})));
  EXPECT_TRUE(meet(kFlat, point({2, 2, 0})));
  EXPECT_FALSE(meet(kFlat, point({3, 3, 0})));
  EXPECT_FALSE(meet(kFlat, point({1, 1, 1})));
  EXPECT_TRUE(meet(point({1, 2, 3}), point({1, 2, 3})));
  EXPECT_FALSE(meet(point({1, 2, 3}), point({1, 2, 4})));
}

}    // namespace
}    // namespace lsdcd::test_triangles
