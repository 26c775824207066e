// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Polygons of files cut into triangles. The oracle is integer arithmetic: corners have whole coordinates, areas are
// sums of products of these, and a point is inside as often as the polygon winds around it.
// LSDCD_QUICK: fewer random polygons, and fewer corners of long ones.
#include "mesh/io/cut_polygon.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>

namespace lsdcd::test_cut_polygon {
namespace {

bool is_quick()
{
  return std::getenv("LSDCD_QUICK") != nullptr;
}

struct Point {
  std::int64_t x, y;
};
using Polygon = std::vector<Point>;

bool operator==(const Point &a, const Point &b)
{
  return a.x == b.x && a.y == b.y;
}

// Twice the signed area of a triangle, exact for coordinates below 2^30.
std::int64_t area(const Point &a, const Point &b, const Point &c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
int sign_of(std::int64_t a)
{
  return a > 0 ? 1 : a < 0 ? -1 : 0;
}
int turn(const Point &a, const Point &b, const Point &c)
{
  return sign_of(area(a, b, c));
}

std::int64_t area(const Polygon &p)
{
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < p.size(); i++) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

bool is_between(const Point &a, const Point &b, const Point &x)
{
  return turn(a, b, x) == 0 && std::min(a.x, b.x) <= x.x && x.x <= std::max(a.x, b.x) &&
         std::min(a.y, b.y) <= x.y && x.y <= std::max(a.y, b.y);
}

// How often the polygon winds around a point; false: the point is on its boundary.
bool winding(const Polygon &p, const Point &x, int &times)
{
  times = 0;
  for (std::size_t i = 0; i < p.size(); i++) {
    const Point &a = p[i], &b = p[(i + 1) % p.size()];
    if (is_between(a, b, x)) return false;
    if (a.y <= x.y && b.y > x.y) times += turn(a, b, x) > 0;
    if (b.y <= x.y && a.y > x.y) times -= turn(a, b, x) < 0;
  }
  return true;
}

// Whole coordinates on a plane through the origin that is not along an axis, so that its points are exact.
Vec3 on_plane(const Point &p, int plane)
{
  const Real x = p.x, y = p.y;
  switch (plane) {
    case 0:
      return {x, y, 0};
    case 1:
      return {x, 2 * x - 3 * y, y};
    case 2:
      return {3 * y - x, x, y};
    default:
      return {x, y, x + y};
  }
}

struct Cut {
  std::string problem;
  std::vector<std::array<Point, 3>> triangles;
};

Cut cut(const Polygon &p, int plane = 0)
{
  std::vector<Vec3> corners, cut;
  std::map<std::array<Real, 3>, Point> point;
  for (const Point &x : p) {
    corners.push_back(on_plane(x, plane));
    point[{corners.back().x, corners.back().y, corners.back().z}] = x;
  }
  Cut result;
  result.problem = cut_polygon(corners, cut);
  for (std::size_t i = 0; i + 2 < cut.size(); i += 3) {
    std::array<Point, 3> t;
    for (int k = 0; k < 3; k++) t[k] = point.at({cut[i + k].x, cut[i + k].y, cut[i + k].z});
    result.triangles.push_back(t);
  }
  return result;
}

Polygon reversed(Polygon p)
{
  std::reverse(p.begin(), p.end());
  return p;
}

// The triangles turn as the polygon does, have its area, and cover random points as often as it winds around these.
void expect_area(const Polygon &p, int plane = 0)
{
  const Cut done = cut(p, plane);
  ASSERT_EQ(done.problem, "");
  const int side = sign_of(area(p));
  std::int64_t sum = 0;
  for (const auto &t : done.triangles) {
    sum += area(t[0], t[1], t[2]);
    ASSERT_NE(turn(t[0], t[1], t[2]), -side);
  }
  ASSERT_EQ(sum, area(p));
  if (p.size() > 200) return;    // what follows takes time in proportion to the square
  // Points at odd coordinates of the polygon enlarged by 2.
  Polygon twice = p;
  Point lo = p[0], hi = p[0];
  for (Point &x : twice) {
    x = {2 * x.x, 2 * x.y};
    lo = {std::min(lo.x, x.x), std::min(lo.y, x.y)};
    hi = {std::max(hi.x, x.x), std::max(hi.y, x.y)};
  }
  Random random(7);
  for (int i = 0; i < 50; i++) {
    const Point x = {lo.x + static_cast<std::int64_t>(uniform(random, 0, 1) * (hi.x - lo.x + 1)),
                     lo.y + static_cast<std::int64_t>(uniform(random, 0, 1) * (hi.y - lo.y + 1))};
    int expected = 0, times = 0;
    if (!winding(twice, x, expected)) continue;
    bool on_side = false;
    for (const auto &t : done.triangles) {
      int of_triangle = 0;
      const Polygon triangle = {
          {2 * t[0].x, 2 * t[0].y}, {2 * t[1].x, 2 * t[1].y}, {2 * t[2].x, 2 * t[2].y}};
      on_side = on_side || !winding(triangle, x, of_triangle);
      times += of_triangle;
    }
    if (!on_side) {
      ASSERT_EQ(times, expected);
    }
  }
}

// The same, and every corner is one of a triangle with area, and on no side of such a triangle.
void expect_exact(const Polygon &p, int plane = 0)
{
  expect_area(p, plane);
  if (p.size() > 200 || ::testing::Test::HasFatalFailure()) return;
  const Cut done = cut(p, plane);
  for (const Point &x : p) {
    bool has = false;
    for (const auto &t : done.triangles)
      for (int k = 0; k < 3; k++) {
        if (turn(t[0], t[1], t[2]) == 0) continue;
        has = has || t[k] == x;
        const Point &a = t[k], &b = t[(k + 1) % 3];
        ASSERT_TRUE(a == x || b == x || !is_between(a, b, x)) << x.x << " " << x.y;
      }
    ASSERT_TRUE(has) << x.x << " " << x.y;
  }
}

// In both windings, on planes, and from several first corners.
void expect_exact_everywhere(const Polygon &p)
{
  for (int plane = 0; plane < 4; plane++)
    for (std::size_t first = 0; first < p.size(); first += 1 + p.size() / 4) {
      Polygon turned = p;
      std::rotate(turned.begin(), turned.begin() + first, turned.end());
      expect_exact(turned, plane);
      expect_exact(reversed(turned), plane);
      if (::testing::Test::HasFatalFailure()) return;
    }
}

const Polygon kL = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};

TEST(cut_polygon, letters_stairs_and_slotted_walls_are_exact)
{
  const Polygon t = {{0, 2}, {0, 3}, {3, 3}, {3, 2}, {2, 2}, {2, 0}, {1, 0}, {1, 2}};
  const Polygon u = {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  Polygon stairs = {{0, 0}, {10, 0}}, slots = {{0, 0}, {40, 0}, {40, 9}};
  for (int i = 10; i > 0; i--) {
    stairs.push_back({i, 11 - i});
    stairs.push_back({i - 1, 11 - i});
  }
  for (int i = 9; i > 0; i--)
    for (const Point &x : {Point{4 * i + 1, 9}, {4 * i + 1, 2}, {4 * i, 2}, {4 * i, 9}})
      slots.push_back(x);
  slots.push_back({0, 9});
  for (const Polygon &p : {kL, t, u, stairs, slots}) expect_exact_everywhere(p);
}

TEST(cut_polygon, collinear_corners_stay_corners_of_triangles)
{
  expect_exact_everywhere({{0, 0}, {1, 0}, {2, 0}, {2, 2}});
  expect_exact_everywhere({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 2}, {1, 1}});
  Polygon square;
  for (int i = 0; i < 8; i++) square.push_back({i, 0});
  for (int i = 0; i < 8; i++) square.push_back({8, i});
  for (int i = 0; i < 8; i++) square.push_back({8 - i, 8});
  for (int i = 0; i < 8; i++) square.push_back({0, 8 - i});
  expect_exact_everywhere(square);
  Polygon l;    // with a corner in the middle of each side
  for (std::size_t i = 0; i < kL.size(); i++) {
    const Point &a = kL[i], &b = kL[(i + 1) % kL.size()];
    l.push_back({2 * a.x, 2 * a.y});
    l.push_back({a.x + b.x, a.y + b.y});
  }
  expect_exact_everywhere(l);
}

TEST(cut_polygon, a_corner_given_twice_in_a_row_counts_once)
{
  EXPECT_EQ(cut({{0, 0}, {1, 0}, {1, 0}, {0, 1}}).triangles.size(), 1u);
  expect_exact_everywhere({{0, 0}, {0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 2}, {0, 2}});
}

TEST(cut_polygon, holes_by_keyholes_stay_open)
{
  // One hole; two by one bridge after the other; two from one corner; one whose bridge is along a side.
  const Polygon one = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0},
                       {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}};
  const Polygon chain = {{0, 0},  {20, 0}, {20, 9}, {0, 9},  {0, 0},  {3, 3}, {3, 6}, {6, 6},
                         {12, 6}, {15, 6}, {15, 3}, {12, 3}, {12, 6}, {6, 6}, {6, 3}, {3, 3}};
  const Polygon fan = {{0, 0},  {3, 12}, {6, 12}, {3, 11}, {3, 12}, {0, 0},   {12, 3},
                       {11, 3}, {12, 6}, {12, 3}, {0, 0},  {20, 0}, {20, 20}, {0, 20}};
  const Polygon along = {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 5}, {3, 5},
                         {3, 7}, {6, 5}, {3, 2}, {3, 5}, {0, 5}};
  Polygon corners;    // the first, with corners along all sides
  for (std::size_t i = 0; i < one.size(); i++)
    for (int k = 0; k < 3; k++) {
      const Point &a = one[i], &b = one[(i + 1) % one.size()];
      corners.push_back({3 * a.x + k * (b.x - a.x), 3 * a.y + k * (b.y - a.y)});
    }
  EXPECT_EQ(std::abs(area(one)), 2 * (81 - 9));
  for (const Polygon &p : {one, corners, chain, along, reversed(fan)}) expect_exact_everywhere(p);
}

TEST(cut_polygon, a_quadrilateral_is_cut_from_its_first_corner_or_across_if_only_that_is_inside)
{
  const Cut square = cut({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(square.triangles[0][0], (Point{0, 0}));
  EXPECT_EQ(square.triangles[0][2], (Point{1, 1}));
  for (const Polygon &p :
       {Polygon{{0, 0}, {4, 4}, {0, 1}, {-4, 4}}, {{0, 1}, {-4, 4}, {0, 0}, {4, 4}}})
    expect_exact_everywhere(p);
}

// Also where it is turned over, as in a double-sided export, and begins at another corner.
TEST(cut_polygon, a_polygon_that_is_there_again_gets_the_triangles_that_it_had)
{
  using Corner = std::array<Real, 3>;
  const auto sorted = [](const Vec3 *begin, std::size_t n, bool turned) {
    std::vector<std::array<Corner, 3>> all;
    for (std::size_t i = 0; i < n; i += 3) {
      std::array<Corner, 3> t;
      for (std::size_t k = 0; k < 3; k++) t[k] = {begin[i + k].x, begin[i + k].y, begin[i + k].z};
      if (turned) std::swap(t[1], t[2]);
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      all.push_back(t);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, bent = {{0, 0}, {3, 0}, {1, 1}, {0, 2}};
  PolygonCutter cutter;
  std::vector<Vec3> triangles;
  for (const Polygon &p : {square, kL, bent})
    for (int plane = 0; plane < 4; plane++) {
      const std::size_t begin = triangles.size(), size = 3 * (p.size() - 2);
      for (std::size_t first = 0; first < p.size(); first++)
        for (const bool turned : {false, true}) {
          std::vector<Vec3> corners;
          for (const Point &x : p) corners.push_back(on_plane(x, plane));
          corners[1].z += 0.25;    // not flat, so that another cut would be another surface
          std::rotate(corners.begin(), corners.begin() + first, corners.end());
          if (turned) std::reverse(corners.begin(), corners.end());
          const std::size_t before = triangles.size();
          ASSERT_EQ(cutter.cut(corners, triangles), "");
          ASSERT_EQ(triangles.size(), before + size);
          EXPECT_EQ(sorted(&triangles[before], size, turned),
                    sorted(&triangles[begin], size, false))
              << first << turned;
        }
    }
}

// Three corners with another between two of them make three arrows.
TEST(cut_polygon, other_polygons_of_the_same_corners_are_cut_for_themselves)
{
  PolygonCutter cutter;
  std::vector<Vec3> triangles;
  const Vec3 a = {0, 0, 0}, b = {4, 0, 0}, c = {1, 1, 0}, d = {0, 4, 0};
  const auto area_of_next = [&](const std::vector<Vec3> &corners) {
    const std::size_t before = triangles.size();
    EXPECT_EQ(cutter.cut(corners, triangles), "");
    Real twice = 0;
    for (std::size_t i = before; i < triangles.size(); i += 3)
      twice += cross(triangles[i + 1] - triangles[i], triangles[i + 2] - triangles[i]).z;
    return twice / 2;
  };
  EXPECT_EQ(area_of_next({a, b, c, d}), 4);
  EXPECT_EQ(area_of_next({a, b, d, c}), 6);
  EXPECT_EQ(area_of_next({a, c, b, d}), 6);
  EXPECT_EQ(area_of_next({d, c, b, a}), -4);
}

TEST(cut_polygon, what_crosses_itself_is_refused_with_its_place)
{
  const auto problem = [](const Polygon &p) {
    const Cut done = cut(p);
    EXPECT_TRUE(done.triangles.empty());
    return done.problem;
  };
  const std::string bowtie = problem({{0, 0}, {4, 4}, {4, 0}, {0, 5}});
  EXPECT_NE(bowtie.find("it crosses itself near ("), bowtie.npos) << bowtie;
  const Polygon others[] = {
      {{0, 0}, {4, 4}, {4, 0}, {0, 4}},                   // of area 0
      {{0, 10}, {-6, -8}, {10, 3}, {-10, 3}, {6, -8}},    // a pentagram
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {9, 0}, {9, 9}, {0, 9}},
      // A hole that is wound as its rim is; a strip that goes over itself; a loop within a loop.
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {6, 3}, {6, 6}, {3, 6}, {3, 3}},
      {{0, 0},
       {20, 0},
       {20, 20},
       {10, 20},
       {10, -10},
       {12, -10},
       {12, 18},
       {18, 18},
       {18, 2},
       {0, 2}},
      {{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {5, 1}, {5, 5}, {1, 5}}};
  for (const Polygon &other : others) EXPECT_NE(problem(other), "");
}

TEST(cut_polygon, corners_in_a_line_give_triangles_without_area)
{
  for (const Polygon &p :
       {Polygon{{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {{0, 0}, {3, 3}, {1, 1}, {2, 2}, {5, 5}}}) {
    const Cut done = cut(p);
    EXPECT_EQ(done.problem, "");
    EXPECT_FALSE(done.triangles.empty());
    for (const auto &t : done.triangles) EXPECT_EQ(area(t[0], t[1], t[2]), 0);
  }
}

// Each edge of the polygon is a side of one triangle, and each other side is one of two in turn: so areas add up as
// vectors, whatever shape the polygon has.
TEST(cut_polygon, what_is_not_flat_is_cut_along_its_edges)
{
  Random random(3);
  for (int n = 4; n < 40; n++) {
    std::vector<Vec3> corners, cut;
    for (int k = 0; k < n; k++) {
      const Real angle = 2 * std::acos(-1.) * k / n, r = k % 2 ? 1 : 0.4;
      corners.push_back({r * std::cos(angle), uniform(random, -0.3, 0.3), r * std::sin(angle)});
    }
    ASSERT_EQ(cut_polygon(corners, cut), "");
    ASSERT_EQ(cut.size(), 3u * (n - 2));
    std::map<std::pair<int, int>, int> sides;
    const auto number = [&](const Vec3 &x) {
      return static_cast<int>(std::find(corners.begin(), corners.end(), x) - corners.begin());
    };
    for (std::size_t i = 0; i < cut.size(); i++) {
      const int a = number(cut[i]), b = number(cut[i % 3 == 2 ? i - 2 : i + 1]);
      sides[{a, b}]++;
      sides[{b, a}]--;
    }
    for (const auto &[side, times] : sides)
      ASSERT_EQ(times, (side.first + 1) % n == side.second   ? 1
                       : (side.second + 1) % n == side.first ? -1
                                                             : 0);
  }
}

bool cross(const Point &a, const Point &b, const Point &c, const Point &d)
{
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return true;
  return is_between(a, b, c) || is_between(a, b, d) || is_between(c, d, a) || is_between(c, d, b);
}

// Random points, joined so that no two sides meet: crossed sides are exchanged until none is left.
Polygon random_polygon(Random &random, int n, int size)
{
  for (;;) {
    Polygon p;
    for (int i = 0; i < n; i++)
      p.push_back({static_cast<std::int64_t>(uniform(random, 0, size)),
                   static_cast<std::int64_t>(uniform(random, 0, size))});
    bool crossed = true;
    for (int round = 0; crossed && round < 200; round++) {
      crossed = false;
      for (int i = 0; i < n; i++)
        for (int j = i + 2; j < n; j++) {
          if ((j + 1) % n == i || !cross(p[i], p[i + 1], p[j], p[(j + 1) % n])) continue;
          std::reverse(p.begin() + i + 1, p.begin() + j + 1);
          crossed = true;
        }
    }
    for (int i = 0; i < n; i++)    // no side goes back along the one before
      crossed = crossed || is_between(p[i], p[(i + 1) % n], p[(i + 2) % n]) ||
                is_between(p[(i + 1) % n], p[(i + 2) % n], p[i]);
    if (!crossed) return p;
  }
}

TEST(cut_polygon, random_simple_polygons_are_exact)
{
  Random random(50);
  const int polygons = is_quick() ? 1000 : 5000;
  for (int i = 0; i < polygons; i++) {
    // On few whole numbers many corners are collinear.
    const Polygon p =
        i % 3 ? random_polygon(random, 4 + i % 27, 1000) : random_polygon(random, 4 + i % 9, 8);
    expect_exact(p, i % 4);
    expect_exact(reversed(p), i % 4);
    if (HasFatalFailure()) FAIL() << "polygon " << i;
  }
}

TEST(cut_polygon, a_polygon_that_touches_itself_is_exact)
{
  // A corner on a side, from inside and from outside; two lobes with one corner in common.
  expect_area({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}});
  // The same with holes, whose bridges touch it.
  Polygon holes = {{0, 0},  {20, 0}, {20, 20}, {18, 16}, {18, 14}, {17, 14}, {18, 16},
                   {10, 0}, {0, 20}, {0, 0},   {2, 2},   {2, 6},   {5, 2},   {2, 2}};
  for (std::size_t i = 0; i < holes.size(); i++) {
    expect_area(holes);
    expect_area(reversed(holes));
    std::rotate(holes.begin(), holes.begin() + 1, holes.end());
  }
  expect_area({{0, 0}, {10, 0}, {10, 10}, {4, 10}, {4, 6}, {10, 3}, {2, 3}, {2, 10}, {0, 10}});
  expect_area({{0, 0}, {4, 0}, {4, 4}, {8, 4}, {8, 8}, {4, 8}, {4, 4}, {0, 4}});
}

// The way around unit squares that hang together as a tree. Neighbours that do not have a slit between them, so that
// most corners are there several times, and sides lie on each other.
class Tree {
 public:
  Tree(Random &random, int n) : random_(random)
  {
    cells_[{0, 0}] = {};
    while (static_cast<int>(cells_.size()) < n) {
      auto parent = cells_.begin();
      std::advance(parent, random_() % cells_.size());
      const int side = static_cast<int>(random_() % 4);
      const auto child = beside(parent->first, side);
      if (cells_.count(child) == 0) cells_[child], parent->second[side] = true;
    }
  }

  // Without every corner at which it goes straight on, or with a half of these.
  Polygon way(bool all)
  {
    way_.clear();
    for (int side = 0; side < 4; side++) go_along({0, 0}, side);
    Polygon kept;
    const std::size_t n = way_.size();
    for (std::size_t i = 0; i < n; i++) {
      const Point &a = way_[(i + n - 1) % n], &b = way_[i], &c = way_[(i + 1) % n];
      if (all || turn(a, b, c) != 0 || a == c || random_() % 2) kept.push_back(b);
    }
    return kept;
  }

 private:
  using Cell = std::array<int, 2>;

  static Cell beside(const Cell &cell, int side)
  {
    constexpr int kStep[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    return {cell[0] + kStep[side][0], cell[1] + kStep[side][1]};
  }
  // From where the side begins, anticlockwise around the cell.
  void go_along(const Cell &cell, int side)
  {
    constexpr int kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (cells_.at(cell)[side]) {
      for (int more = 1; more < 4; more++) go_along(beside(cell, side), (side + 2 + more) % 4);
    } else {
      way_.push_back({cell[0] + kCorner[side][0], cell[1] + kCorner[side][1]});
    }
  }

  Random &random_;
  std::map<Cell, std::array<bool, 4>> cells_;    // sides with a child
  Polygon way_;
};

TEST(cut_polygon, sides_that_lie_on_each_other_are_exact)
{
  Random random(52);
  const int polygons = is_quick() ? 1000 : 5000;
  for (int i = 0; i < polygons; i++) {
    Tree tree(random, 2 + i % 40);
    const Polygon p = tree.way(i % 2 == 0);
    expect_area(p, i % 4);
    expect_area(reversed(p), i % 4);
    if (HasFatalFailure()) FAIL() << "polygon " << i;
  }
}

// Turned in space, so that its coordinates are rounded, a polygon is cut too, though corners on straight sides are now
// beside them. It is within 4000 of the origin, so corners move by less than 4000 times 1e-15, and the area by that along
// n sides below 2000.
TEST(cut_polygon, rounded_corners_change_the_area_by_rounding_only)
{
  Random random(51);
  const int polygons = is_quick() ? 200 : 5000;
  for (int i = 0; i < polygons; i++) {
    const Polygon p =
        i % 3 ? random_polygon(random, 4 + i % 27, 1000) : random_polygon(random, 4 + i % 9, 8);
    const Vec3 u = random_unit(random), v = unit(cross(u, random_unit(random)));
    const Vec3 origin = uniform(random, Vec3{-1000, -1000, -1000}, Vec3{1000, 1000, 1000});
    std::vector<Vec3> corners, cut;
    for (const Point &x : p)
      corners.push_back(origin + static_cast<Real>(x.x) * u + static_cast<Real>(x.y) * v);
    ASSERT_EQ(cut_polygon(corners, cut), "") << "polygon " << i;
    Real sum = 0;
    for (std::size_t c = 0; c < cut.size(); c += 3)
      sum += norm(cross(cut[c + 1] - cut[c], cut[c + 2] - cut[c]));
    ASSERT_NEAR(sum, std::abs(area(p)), 4000 * 1e-15 * 2000 * p.size()) << "polygon " << i;
  }
}

// n^2 steps of 1e5 corners would be hours if each took a microsecond. A comb whose back has two corners takes about
// n^2 / 2 tests of boxes, as one of these is a corner of each triangle, so it is shorter. All: 6 s.
TEST(cut_polygon, a_hundred_thousand_corners_are_cut)
{
  const int n = is_quick() ? 10000 : 100000;
  Polygon comb, line, spiral, round, star;
  for (int i = 0; i < n / 2; i++) {
    comb.push_back({2 * i, i % 7});
    comb.push_back({2 * i + 1, 5000 + i % 11});
  }
  comb.push_back({n, -10});
  comb.push_back({-1, -10});
  for (int i = 0; i < n; i++) line.push_back({i, 0});
  line.push_back({n - 1, 1});
  line.push_back({0, 1});
  const Real pi = std::acos(-1.);
  const auto at = [](Real r, Real angle) {
    return Point{std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))};
  };
  for (int i = 0; i < n / 2; i++) spiral.push_back(at(1e6 + 100. * i, i * 0.003));
  for (int i = n / 2; i-- > 0;) spiral.push_back(at(1e6 + 100. * i + 5e4, i * 0.003));
  for (int i = 0; i < n; i++) round.push_back(at(1e9, 2 * pi * i / n));
  for (int i = 0; i < n; i++) star.push_back(at(i % 2 ? 1e9 : 2e8, 2 * pi * i / n));
  for (const Polygon &p : {comb, line, spiral, round, star}) expect_exact(p);
}

}    // namespace
}    // namespace lsdcd::test_cut_polygon
