// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Winding numbers of points around closed surfaces, against sums of solid angles (van Oosterom and
// Strackee 1983) and closed forms of boxes.
#include "mesh/winding_number.h"

#include "base/input_error.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace lsdcd::test_winding_number {
namespace {

// In long double; near the surface it is no whole number.
long double by_solid_angles(const TriangleSoup &soup, const Vec3 &q)
{
  using Wide = long double;
  Wide sum = 0;
  for (std::size_t t = 0; t < soup.corners.size(); t += 3) {
    Wide d[3][3], r[3];
    for (int k = 0; k < 3; k++) {
      for (int a = 0; a < 3; a++) d[k][a] = Wide(soup.corners[t + k][a]) - q[a];
      r[k] = std::sqrt(d[k][0] * d[k][0] + d[k][1] * d[k][1] + d[k][2] * d[k][2]);
    }
    const auto dot = [&](int i, int j) {
      return d[i][0] * d[j][0] + d[i][1] * d[j][1] + d[i][2] * d[j][2];
    };
    const Wide det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                     d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                     d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    sum += std::atan2(det,
                      r[0] * r[1] * r[2] + dot(0, 1) * r[2] + dot(1, 2) * r[0] + dot(2, 0) * r[1]);
  }
  return sum / (2 * 3.14159265358979323846L);
}

// Shells that cut themselves everywhere; `lattice` > 0: with vertices at whole numbers below it.
TriangleSoup crumpled(std::mt19937_64 &dice, int n, int lattice)
{
  std::vector<Vec3> x(n * n);
  for (Vec3 &p : x) {
    p = uniform(dice, {0, 0, 0}, {1, 1, 1});
    for (int k = 0; lattice > 0 && k < 3; k++) p[k] = std::floor(p[k] * lattice);
  }
  return crumpled_torus(x, n);
}

// Points whose sum of solid angles is within 1e-6 of a whole number are compared. Long double rounds it by 1e-18
// for each facet, so that those are off the surface, and the whole number is theirs.
void expect_solid_angles(const TriangleSoup &soup, std::mt19937_64 &dice, int n, const Vec3 &lo,
                         const Vec3 &hi)
{
  const WindingNumber winding(weld(soup, 0));
  int compared = 0;
  for (int i = 0; i < n; i++) {
    const Vec3 q = uniform(dice, lo, hi);
    const long double sum = by_solid_angles(soup, q);
    const int number = static_cast<int>(std::lround(sum));
    if (std::fabs(sum - number) > 1e-6) continue;
    compared++;
    const WindingNumber::Answer a = winding.at(q);
    ASSERT_FALSE(a.on_surface) << q.x << " " << q.y << " " << q.z;
    ASSERT_EQ(a.number, number) << q.x << " " << q.y << " " << q.z;
  }
  EXPECT_GT(compared, n / 2);
}

TEST(winding_number, is_the_sum_of_solid_angles_where_shells_cut_themselves)
{
  std::mt19937_64 dice(1);
  for (const int n : {3, 5, 9, 20})
    expect_solid_angles(crumpled(dice, n, 0), dice, 1000, {-0.2, -0.2, -0.2}, {1.2, 1.2, 1.2});
}

TEST(winding_number, is_the_sum_of_solid_angles_where_shells_cut_and_contain_each_other)
{
  std::mt19937_64 dice(2);
  TriangleSoup soup = cylinder_mesh(40, 30, 0.5, 1);
  append(soup, moved(cylinder_mesh(31, 7, 0.4, 0.7), {0.3, 0.1, 0.2}));
  append(soup, box_mesh({-0.2, -0.2, 0.1}, {0.2, 0.2, 0.9}));
  append(soup, inverted(box_mesh({0.1, -0.1, 0.2}, {0.6, 0.3, 0.4})));
  expect_solid_angles(soup, dice, 1000, {-0.6, -0.6, -0.6}, {1.1, 1.1, 1.1});
}

// A fine part fills one cell of a large box, so that a tree finds its facets.
TEST(winding_number, is_the_sum_of_solid_angles_at_a_part_that_is_far_finer_than_the_box)
{
  std::mt19937_64 dice(6);
  TriangleSoup soup = cylinder_mesh(40, 30, 0.5, 1);
  for (Vec3 &x : soup.corners) x = 1e-3 * x;
  append(soup, box_mesh({-1, -2, -3}, {2, 2, 2}));
  expect_solid_angles(soup, dice, 500, {-6e-4, -6e-4, -1e-4}, {6e-4, 6e-4, 1.1e-3});
  expect_solid_angles(soup, dice, 100, {-2, -2, -4}, {3, 3, 3});
}

// Far from the origin a place in a cell rounds, and so does the middle of an edge.
TEST(winding_number, is_the_sum_of_solid_angles_far_from_the_origin)
{
  std::mt19937_64 dice(5);
  for (const Real far : {1e6, 1e10, 1e12}) {
    TriangleSoup soup = cylinder_mesh(24, 8, 0.5, 1);
    append(soup, box_mesh({-0.2, -0.2, 0.1}, {0.6, 0.2, 0.9}));
    expect_solid_angles(moved(soup, {far, 0, -far}), dice, 500, {far - 0.6, -0.6, -far - 0.1},
                        {far + 0.7, 0.6, -far + 1.1});
  }
}

// Rays go through edges and vertices, along edges and in the planes of facets.
TEST(winding_number, is_the_sum_of_solid_angles_where_rays_meet_edges_and_vertices)
{
  std::mt19937_64 dice(3);
  long compared = 0, on = 0;
  for (int k = 0; k < 120; k++) {
    const int lattice = k % 2 ? 3 : 6;
    const TriangleSoup soup = crumpled(dice, 3 + k % 5, lattice);
    const WeldedMesh mesh = weld(soup, 0);
    // Between two facets that cancel, a sum may be any number.
    if (mesh.report.duplicate_facets > 0) continue;
    const WindingNumber winding(mesh);
    for (int i = 0; i < 300; i++) {
      Vec3 q;
      for (int d = 0; d < 3; d++) q[d] = std::round(2 * uniform(dice, 0, lattice)) / 2;
      const long double sum = by_solid_angles(soup, q);
      const WindingNumber::Answer a = winding.at(q);
      // Off the surface, solid angles of a lattice's facets are exact to 1e-15.
      if (!a.on_surface) {
        compared++;
        ASSERT_NEAR(static_cast<double>(sum), a.number, 1e-9) << q.x << " " << q.y << " " << q.z;
      } else {
        on++;
        EXPECT_EQ(winding.side(q), 1);
      }
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(on, 1000);
}

// The numbers of points on a lattice, which are in the planes of faces, in line with edges, and on all of these.
template <class Number>
void expect_on_lattice(const TriangleSoup &soup, int lo, int hi, const Number &number)
{
  const WindingNumber winding(weld(soup, 0));
  for (int i = 4 * lo; i <= 4 * hi; i++)
    for (int j = 4 * lo; j <= 4 * hi; j++)
      for (int k = 4 * lo; k <= 4 * hi; k++) {
        const Vec3 q = {i / 4., j / 4., k / 4.};
        const WindingNumber::Answer a = winding.at(q), wanted = number(q);
        ASSERT_EQ(a.on_surface, wanted.on_surface) << q.x << " " << q.y << " " << q.z;
        if (!a.on_surface) {
          ASSERT_EQ(a.number, wanted.number) << q.x << " " << q.y << " " << q.z;
        }
      }
}

struct BoxOf {
  Vec3 lo, hi;
  int number = 1;

  bool holds(const Vec3 &q) const
  {
    return q.x >= lo.x && q.x <= hi.x && q.y >= lo.y && q.y <= hi.y && q.z >= lo.z && q.z <= hi.z;
  }
  bool inside(const Vec3 &q) const
  {
    return q.x > lo.x && q.x < hi.x && q.y > lo.y && q.y < hi.y && q.z > lo.z && q.z < hi.z;
  }
};

void expect_boxes(const std::vector<BoxOf> &boxes, int lo, int hi)
{
  TriangleSoup soup;
  for (const BoxOf &b : boxes) {
    const TriangleSoup box = box_mesh(b.lo, b.hi);
    append(soup, b.number > 0 ? box : inverted(box));
  }
  soup.source = "boxes";
  expect_on_lattice(soup, lo, hi, [&](const Vec3 &q) {
    WindingNumber::Answer a = {false, 0};
    for (const BoxOf &b : boxes) {
      a.on_surface = a.on_surface || (b.holds(q) && !b.inside(q));
      a.number += b.inside(q) ? b.number : 0;
    }
    return a;
  });
}

TEST(winding_number, is_the_sum_of_those_of_boxes)
{
  const BoxOf small = {{1, 1, 1}, {2, 2, 2}}, cavity = {{1, 1, 1}, {2, 2, 2}, -1},
              large = {{0, 0, 0}, {3, 3, 3}}, inwards = {{0, 0, 0}, {3, 3, 3}, -1};
  const struct {
    const char *what;
    std::vector<BoxOf> boxes;
  } rows[] = {{"cut each other", {{{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}}}},
              {"share an edge", {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 0}, {2, 2, 1}}}},
              {"share a part of a face", {{{0, 0, 0}, {1, 2, 2}}, {{1, 1, 1}, {2, 3, 3}}}},
              {"one in another", {large, small}},
              {"one wound against the other that it is in", {large, cavity}},
              {"wound inside out", {inwards}}};
  for (const auto &row : rows) {
    SCOPED_TRACE(row.what);
    expect_boxes(row.boxes, -1, 4);
  }
}

// Welded they have one face in common, a sheet: both sides of it are inside, and it is surface.
TEST(winding_number, counts_boxes_that_share_a_face)
{
  TriangleSoup left = box_mesh({0, 0, 0}, {1, 1, 1}), right = left;
  for (Vec3 &x : right.corners) x.x = 2 - x.x;    // its diagonals lie as those of the other
  expect_on_lattice(joined(left, inverted(right)), -1, 3, [](const Vec3 &q) {
    const BoxOf both = {{0, 0, 0}, {2, 1, 1}};
    return WindingNumber::Answer{both.holds(q) && (!both.inside(q) || q.x == 1), both.inside(q)};
  });
}

TEST(winding_number, counts_a_surface_that_a_file_has_twice_once)
{
  const TriangleSoup box = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(WindingNumber(weld(joined(box, box), 0)).at({0.5, 0.5, 0.5}).number, 1);
}

// Where a file has copies of a facet, the winding that has more of them decides, whichever comes first.
TEST(winding_number, counts_three_copies_of_a_surface_by_the_winding_of_two)
{
  const TriangleSoup out = box_mesh({0, 0, 0}, {1, 1, 1}), in = inverted(out);
  for (const TriangleSoup &soup : {joined(joined(out, in), out), joined(joined(in, out), out)}) {
    const WeldedMesh mesh = weld(soup, 0);
    EXPECT_FALSE(mesh.report.oriented);
    EXPECT_EQ(WindingNumber(mesh).at({0.5, 0.5, 0.5}).number, 1);
  }
}

// A sheet in a box from wall to wall, as exporters write one that has no thickness.
TEST(winding_number, does_not_change_across_a_sheet_in_both_windings_and_is_of_the_surface_on_it)
{
  TriangleSoup sheet = box_mesh({1, 1, 1}, {2, 2, 2});
  sheet.corners.resize(6);
  const Vec3 on = Real(0.5) * (sheet.corners[0] + sheet.corners[1]);
  const WeldedMesh mesh =
      weld(joined(joined(box_mesh({0, 0, 0}, {3, 3, 3}), sheet), inverted(sheet)), 0);
  EXPECT_TRUE(has_inside(mesh));
  const WindingNumber winding(mesh);
  EXPECT_TRUE(winding.at(on).on_surface);
  EXPECT_EQ(winding.side(on), 1);
  for (const Real off : {-1e-15, 1e-15})
    for (int k = 0; k < 3; k++) {
      Vec3 q = on;
      q[k] += off;
      if (winding.at(q).on_surface) continue;    // along the sheet
      EXPECT_EQ(winding.at(q).number, 1);
    }
}

// A facet without area leaves an edge, another one a point: distances are 0 there.
TEST(winding_number, is_of_the_surface_on_edges_and_points_without_faces)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {3, 3, 3});
  const Vec3 a = {1, 1, 1}, b = {2, 2, 1.5}, c = {0.5, 0.5, 0.25};
  soup.corners.insert(soup.corners.end(), {a, b, b, c, c, c, a, b, Real(0.5) * (a + b)});
  const WindingNumber winding(weld(soup, 0));
  for (const Vec3 &q : {a, b, c, Real(0.5) * (a + b), Real(0.25) * (Real(3) * a + b)})
    EXPECT_TRUE(winding.at(q).on_surface) << q.x << " " << q.y << " " << q.z;
  for (const Vec3 &q : {a - Real(0.5) * (b - a), c + Vec3{1e-15, 0, 0}, Vec3{1.5, 1.5, 1.5}})
    EXPECT_EQ(winding.side(q), -1) << q.x << " " << q.y << " " << q.z;
}

// The top of a box is cut into a large triangle and two facets without area along an edge.
TEST(winding_number, is_that_of_a_surface_with_facets_without_area)
{
  const TriangleSoup box = box_mesh({0, 0, 0}, {1, 1, 1});
  TriangleSoup soup;
  soup.source = "box";
  const Vec3 a = box.corners[0], b = box.corners[1], c = box.corners[2],
             m = Real(0.5) * (a + b);    // on an edge of the first facet, not of its neighbour
  for (const Vec3 &x : {a, m, c, m, b, c, a, b, m}) soup.corners.push_back(x);
  soup.corners.insert(soup.corners.end(), box.corners.begin() + 3, box.corners.end());
  const WeldedMesh mesh = weld(soup, 0);
  EXPECT_FALSE(mesh.report.closed);
  EXPECT_EQ(mesh.report.degenerate_facets, 1u);
  const WindingNumber winding(mesh);
  EXPECT_EQ(winding.side({0.5, 0.5, 0.5}), -1);
  EXPECT_EQ(winding.side({0.5, 0.5, 1.5}), 1);
  EXPECT_EQ(winding.side(m), 1);
}

// A tetrahedron as fine as the last bits of its coordinates allow.
TEST(winding_number, is_exact_one_bit_from_a_facet)
{
  TriangleSoup soup;
  soup.source = "tetrahedron";
  const Vec3 a = {0.1, 0.2, 0.3}, b = {1.1, 0.3, 0.2}, c = {0.2, 1.3, 0.4}, d = {0.3, 0.4, 1.7};
  for (const Vec3 &x : {a, c, b, a, b, d, b, c, d, c, a, d}) soup.corners.push_back(x);
  const WindingNumber winding(weld(soup, 0));
  std::mt19937_64 dice(4);
  std::uniform_real_distribution<long double> share(0.1L, 0.3L);
  for (int i = 0; i < 10000; i++) {
    const long double s = share(dice), t = share(dice);
    const auto on = [&](int k) { return b[k] + s * (c[k] - b[k]) + t * (d[k] - b[k]); };
    Vec3 q = {static_cast<Real>(on(0)), static_cast<Real>(on(1)), static_cast<Real>(on(2))};
    // The sign of a determinant in 64 bits is right where the point is 4 last places off.
    for (const int bits : {-8, 8}) {
      Vec3 p = q;
      for (int k = 0; k < std::abs(bits); k++) p.x = std::nextafter(p.x, bits < 0 ? -9. : 9.);
      EXPECT_EQ(winding.side(p), bits < 0 ? -1 : 1);
    }
  }
}

TEST(winding_number, is_0_at_any_distance_outside_and_where_a_point_is_no_number)
{
  const WindingNumber winding(weld(box_mesh({0, 0, 0}, {1, 1, 1}), 0));
  for (const Real x : {1.0000001, 1e3, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_EQ(winding.at({x, 0.5, 0.5}).number, 0);
    EXPECT_EQ(winding.at({0.5, 0.5, x}).number, 0);
  }
}

TEST(winding_number, is_refused_with_what_keeps_the_mesh_from_having_an_inside)
{
  const TriangleSoup box = box_mesh({0, 0, 0}, {1, 1, 1}), far = box_mesh({1, 1, 1}, {2, 2, 2}),
                     twice = joined(far, inverted(far));
  TriangleSoup open = box, turned = box, two = box;
  open.corners.resize(box.corners.size() - 3);
  std::swap(turned.corners[0], turned.corners[1]);
  two.corners.resize(6);
  const std::string double_sided = "each of its facets is there in both windings, as in a "
                                   "double-sided export, so it encloses nothing: lsdcd repair "
                                   "keeps one of each pair",
                    of_24 = "12 of 24 facets are there in both windings";
  const struct {
    TriangleSoup soup;
    std::size_t two_sided;
    std::vector<std::string> told;
  } rows[] = {
      {open, 0, {"3 edges are open", "the first goes from", "lsdcd repair"}},
      {turned, 0, {"along 3 more facets"}},
      // All answers are the same, whichever winding comes first.
      {joined(box, inverted(box)), 12, {double_sided}},
      {joined(inverted(box), box), 12, {double_sided}},
      {joined(two, inverted(two)), 2, {double_sided}},
      {joined(box, inverted(two)), 2, {"2 of 12 facets are there in both windings", "4 edges are"}},
      // Its inside would be outside beside another box, and the cavity of a box in one solid.
      {joined(box_mesh({0, 0, 0}, {3, 3, 3}), twice), 12, {of_24, "lsdcd repair"}},
      {joined(box_mesh({0, 0, 0}, {0.5, 0.5, 0.5}), twice), 12, {of_24, "lsdcd repair"}}};
  for (const auto &row : rows) {
    const WeldedMesh mesh = weld(row.soup, 0);
    EXPECT_EQ(mesh.report.two_sided_faces, row.two_sided);
    EXPECT_FALSE(mesh.report.oriented);
    EXPECT_FALSE(has_inside(mesh));
    EXPECT_TRUE(says(why_no_inside(mesh), row.told));
    EXPECT_TRUE(has(error_of([&] { WindingNumber winding(mesh); }), row.told[0]));
  }
}

}    // namespace
}    // namespace lsdcd::test_winding_number
