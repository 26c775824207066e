// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Winding numbers of points about surfaces that are open, or broken, against closed forms of rectangles and
// sums of spherical excesses (Girard) in long double.
#include "mesh/generalized_winding.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace lsdcd::test_generalized_winding {
namespace {

using Wide = long double;

// Over the sphere of directions: the signed angles of each facet's corner sum to pi and its area.
Wide by_excess(const TriangleSoup &soup, const Vec3 &q)
{
  struct Direction {
    Wide x[3];
    Wide dot(const Direction &b) const { return x[0] * b.x[0] + x[1] * b.x[1] + x[2] * b.x[2]; }
    Direction cross(const Direction &b) const
    {
      return {{x[1] * b.x[2] - x[2] * b.x[1], x[2] * b.x[0] - x[0] * b.x[2],
               x[0] * b.x[1] - x[1] * b.x[0]}};
    }
  };
  Wide sum = 0;
  for (std::size_t t = 0; t < soup.corners.size(); t += 3) {
    Direction d[3];
    for (int k = 0; k < 3; k++)
      for (int a = 0; a < 3; a++) d[k].x[a] = Wide(soup.corners[t + k][a]) - q[a];
    const Wide det = d[0].dot(d[1].cross(d[2]));
    if (det == 0) continue;
    Wide excess = -3.14159265358979323846L;
    for (int k = 0; k < 3; k++) {
      const Direction one = d[k].cross(d[(k + 1) % 3]), other = d[k].cross(d[(k + 2) % 3]),
                      both = one.cross(other);
      excess += std::atan2(std::sqrt(both.dot(both)), one.dot(other));
    }
    sum += det > 0 ? excess : -excess;
  }
  return sum / (4 * 3.14159265358979323846L);
}

// The plane z = 0 with x below `x` and y below `y`, seen from (0, 0, z): so a rectangle is four of these.
Wide quarter(Wide x, Wide y, Wide z)
{
  return std::atan2(x * y, z * std::sqrt(x * x + y * y + z * z));
}
// The number of the rectangle lo to hi in a plane across `axis`, whose normal points along it; on it, the mean of both
// sides.
Wide by_rectangle(int axis, const Vec3 &lo, const Vec3 &hi, const Vec3 &q)
{
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Wide z = Wide(lo[axis]) - q[axis];
  if (z == 0) return 0;
  const auto corner = [&](const Vec3 &x, const Vec3 &y) {
    return quarter(Wide(x[u]) - q[u], Wide(y[v]) - q[v], std::fabs(z));
  };
  const Wide angle = corner(hi, hi) - corner(lo, hi) - corner(hi, lo) + corner(lo, lo);
  return (z > 0 ? angle : -angle) / (4 * 3.14159265358979323846L);
}

// A box without its face at hi along x.
TriangleSoup open_box(const Vec3 &lo, const Vec3 &hi)
{
  TriangleSoup all = box_mesh(lo, hi), soup;
  soup.source = "open box";
  for (std::size_t t = 0; t < all.corners.size(); t += 3) {
    const Vec3 *c = &all.corners[t];
    if (c[0].x == hi.x && c[1].x == hi.x && c[2].x == hi.x) continue;
    soup.corners.insert(soup.corners.end(), c, c + 3);
  }
  return soup;
}
Wide by_open_box(const Vec3 &lo, const Vec3 &hi, const Vec3 &q)
{
  Wide sum = 0;
  for (int axis = 0; axis < 3; axis++) {
    Vec3 below = hi, above = lo;
    below[axis] = lo[axis];
    above[axis] = hi[axis];
    sum -= by_rectangle(axis, lo, below, q);
    if (axis > 0) sum += by_rectangle(axis, above, hi, q);
  }
  return sum;
}

Vec3 random_point(std::mt19937_64 &dice, Real lo, Real hi)
{
  std::uniform_real_distribution<Real> in(lo, hi);
  const Real x = in(dice), y = in(dice), z = in(dice);
  return {x, y, z};
}

// Each facet's angle rounds by some 1e-16, over how far the point is from edges: of points at random some
// are at 1e-4. For so many facets:
constexpr double kTolerance = 1e-11;

void expect_excess(const TriangleSoup &soup, std::mt19937_64 &dice, int n)
{
  const GeneralizedWinding winding(weld(soup, 0));
  for (int i = 0; i < n; i++) {
    const Vec3 q = random_point(dice, -0.2, 1.2);
    const GeneralizedWinding::Answer a = winding.at(q);
    ASSERT_FALSE(a.on_surface);
    ASSERT_NEAR(a.number, static_cast<double>(by_excess(soup, q)), kTolerance)
        << q.x << " " << q.y << " " << q.z;
  }
}

TriangleSoup crumpled(std::mt19937_64 &dice, int n)
{
  std::vector<Vec3> x(n * n);
  for (Vec3 &p : x) p = random_point(dice, 0, 1);
  return crumpled_torus(x, n);
}

// Facets for which keep() is false are left out, those for which turn() is true are turned.
template <class Keep, class Turn>
TriangleSoup changed(const TriangleSoup &from, const Keep &keep, const Turn &turn)
{
  TriangleSoup soup;
  soup.source = from.source;
  for (std::size_t t = 0; t < from.corners.size(); t += 3) {
    if (!keep()) continue;
    const int other = turn() ? 2 : 1;
    for (const int k : {0, other, 3 - other}) soup.corners.push_back(from.corners[t + k]);
  }
  return soup;
}

TEST(generalized_winding, is_the_closed_form_above_a_plate)
{
  TriangleSoup plate;
  plate.corners = {{-1, -2, 0}, {1, -2, 0}, {1, 2, 0}, {-1, -2, 0}, {1, 2, 0}, {-1, 2, 0}};
  const GeneralizedWinding winding(weld(plate, 0));
  for (const double z : {1e-3, 0.1, 1., 10., 1e3}) {
    const double wanted = std::atan(2 / (z * std::sqrt(5 + z * z))) / kPi;    // 4 atan(...) / 4 pi
    const double rounding = 1e-15 * (1 + 5 / z);    // the diagonal of the plate is at z
    EXPECT_NEAR(winding.at({0, 0, -z}).number, wanted, rounding) << z;
    EXPECT_NEAR(winding.at({0, 0, z}).number, -wanted, rounding) << z;
  }
}

// On a lattice points are in the planes of faces and of the hole, on the edges of these, and on the mesh.
TEST(generalized_winding, is_the_closed_form_in_the_planes_of_faces_and_on_the_mesh)
{
  const Vec3 lo = {0, 0, 0}, hi = {2, 3, 1};
  const GeneralizedWinding winding(weld(open_box(lo, hi), 0));
  int on = 0;
  for (int i = -4; i <= 12; i++)
    for (int j = -4; j <= 16; j++)
      for (int k = -4; k <= 8; k++) {
        const Vec3 q = {i / 4., j / 4., k / 4.};
        const bool in_box = q.x >= 0 && q.x <= 2 && q.y >= 0 && q.y <= 3 && q.z >= 0 && q.z <= 1;
        const bool on_mesh = in_box && (q.x == 0 || q.y == 0 || q.y == 3 || q.z == 0 || q.z == 1);
        const GeneralizedWinding::Answer a = winding.at(q);
        ASSERT_EQ(a.on_surface, on_mesh) << q.x << " " << q.y << " " << q.z;
        ASSERT_NEAR(a.number, static_cast<double>(by_open_box(lo, hi, q)), 1e-14)
            << q.x << " " << q.y << " " << q.z;
        on += on_mesh;
      }
  EXPECT_GT(on, 100);
}

// Next to the hole's plane, to its edges and to the diagonal of its cap.
TEST(generalized_winding, is_the_closed_form_however_near_a_point_is_to_the_hole)
{
  const Vec3 lo = {0, 0, 0}, hi = {1, 1, 1};
  const GeneralizedWinding winding(weld(open_box(lo, hi), 0));
  std::mt19937_64 dice(1);
  std::uniform_real_distribution<Real> in(0, 1);
  for (const Real off : {1e-2, 1e-5, 1e-8, 1e-12, 1e-16})
    for (int i = 0; i < 200; i++) {
      const Real along = in(dice), beside = i % 2 ? off : in(dice) -along;
      const auto expect = [&](const Vec3 &q, double tolerance) {
        ASSERT_NEAR(winding.at(q).number, static_cast<double>(by_open_box(lo, hi, q)), tolerance)
            << q.x - 1 << " " << q.y << " " << q.z;
      };
      for (const Real x : {1 - off, 1 + 2 * off}) {
        expect({x, along, along + beside}, kTolerance);
        expect({x, along, 1 - along + beside}, kTolerance);
        expect({x, along, 1 - off}, kTolerance + 1e-15 / off);    // beside an edge of the mesh
      }
    }
}

// Half as wide is a quarter as much.
TEST(generalized_winding, of_a_surface_with_a_hole_tends_to_that_of_the_closed_one)
{
  for (const double wide : {0.5, 0.05, 0.005}) {
    // The face at x = 1 as a frame round the hole.
    TriangleSoup soup = open_box({-1, -1, -1}, {1, 1, 1});
    const double side[2] = {1, wide};
    const auto corner = [&](int which, int k) {
      const double s = side[which];
      const Vec3 of[4] = {{1, -s, -s}, {1, s, -s}, {1, s, s}, {1, -s, s}};
      return of[k % 4];
    };
    for (int k = 0; k < 4; k++)
      for (const Vec3 &x : {corner(0, k), corner(0, k + 1), corner(1, k + 1), corner(0, k),
                            corner(1, k + 1), corner(1, k)})
        soup.corners.push_back(x);
    const GeneralizedWinding winding(weld(soup, 0));
    const double hole = std::atan(wide * wide / std::sqrt(2 * wide * wide + 1)) / kPi;
    EXPECT_NEAR(winding.at({0, 0, 0}).number, 1 - hole, 1e-14) << wide;
    EXPECT_EQ(GeneralizedWinding::side(winding.at({0, 0, 0})), -1);
    EXPECT_EQ(GeneralizedWinding::side(winding.at({0, 1.5, 0})), 1);
  }
}

TEST(generalized_winding, is_the_sum_of_excesses_where_facets_are_missing_or_flipped)
{
  std::mt19937_64 dice(2);
  for (const double share : {0.02, 0.2, 0.6})
    for (const int n : {5, 12}) {
      const auto some = [&] { return dice() % 1000 < 1000 * share; };
      const TriangleSoup whole = crumpled(dice, n);
      expect_excess(changed(
                        whole, [&] { return !some(); }, [] { return false; }),
                    dice, 100);
      expect_excess(changed(
                        whole, [] { return true; }, some),
                    dice, 100);
    }
}

// All edges are loose, and no caps are made.
TEST(generalized_winding, is_the_sum_of_excesses_of_triangles_that_have_nothing_in_common)
{
  std::mt19937_64 dice(4);
  TriangleSoup soup;
  for (int i = 0; i < 300; i++) soup.corners.push_back(random_point(dice, 0, 1));
  expect_excess(soup, dice, 100);
}

TEST(generalized_winding, counts_facets_that_a_file_has_twice_once)
{
  std::mt19937_64 dice(5);
  const TriangleSoup once = open_box({0, 0, 0}, {1, 1, 1});
  TriangleSoup twice = once;
  twice.corners.insert(twice.corners.end(), once.corners.begin(), once.corners.begin() + 12);
  const GeneralizedWinding a(weld(once, 0)), b(weld(twice, 0));
  for (int i = 0; i < 100; i++) {
    const Vec3 q = random_point(dice, -1, 2);
    EXPECT_NEAR(a.at(q).number, b.at(q).number, 1e-14);
  }
}

// A third of each facet's edge is cut off by a sliver, which its neighbour does not have.
TEST(generalized_winding, is_that_of_the_surface_where_facets_are_nearly_lines)
{
  const Vec3 lo = {0, 0, 0}, hi = {1, 1, 1};
  for (const Real height : {1e-3, 1e-8, 1e-12, 1e-15}) {
    const TriangleSoup box = open_box(lo, hi);
    TriangleSoup soup;
    for (std::size_t t = 0; t < box.corners.size(); t += 3) {
      const Vec3 *c = &box.corners[t];
      const Vec3 m = (1 - height) * (0.5 * c[0] + 0.5 * c[1]) + height * c[2];
      for (const Vec3 &x : {c[0], m, c[2], m, c[1], c[2], c[0], c[1], m}) soup.corners.push_back(x);
    }
    const GeneralizedWinding winding(weld(soup, 0));
    std::mt19937_64 dice(6);
    for (int i = 0; i < 200; i++) {
      const Vec3 q = random_point(dice, -0.5, 1.5);
      // The point m rounds by 1e-16, in the plane of the facet, where that is across an axis.
      ASSERT_NEAR(winding.at(q).number, static_cast<double>(by_open_box(lo, hi, q)), kTolerance)
          << height;
    }
  }
}

TEST(generalized_winding, is_the_whole_number_of_a_closed_surface)
{
  std::mt19937_64 dice(7);
  const WeldedMesh mesh = weld(crumpled(dice, 9), 0);
  const GeneralizedWinding winding(mesh);
  const WindingNumber exact(mesh);
  for (int i = 0; i < 1000; i++) {
    const Vec3 q = random_point(dice, -0.1, 1.1);
    EXPECT_EQ(winding.at(q).number, exact.at(q).number);
  }
}

TEST(generalized_winding, has_the_same_sides_where_normals_point_in)
{
  std::mt19937_64 dice(8);
  const TriangleSoup box = open_box({0, 0, 0}, {1, 1, 1});
  const GeneralizedWinding out(weld(box, 0)), in(weld(inverted(box), 0));
  std::set<int> sides;
  for (int i = 0; i < 1000; i++) {
    const Vec3 q = random_point(dice, -0.5, 1.5);
    const int side = GeneralizedWinding::side(out.at(q));
    EXPECT_EQ(GeneralizedWinding::side(in.at(q)), side);
    sides.insert(side);
  }
  EXPECT_EQ(sides.size(), 2u);
}

TEST(generalized_winding, is_0_far_away_and_where_a_point_is_no_number)
{
  const GeneralizedWinding winding(weld(open_box({0, 0, 0}, {1, 1, 1}), 0));
  for (const Real x : {1e9, 1e100, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_NEAR(winding.at({x, 0.5, 0.5}).number, 0, 1e-15);
    EXPECT_NEAR(winding.at({0.5, 0.5, x}).number, 0, 1e-15);
  }
}

}    // namespace
}    // namespace lsdcd::test_generalized_winding
