// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/input_error.h"
#include "mesh/assemble.h"
#include "mesh/fingerprint.h"
#include "mesh/measure_mesh.h"
#include "mesh/placement.h"
#include "mesh/weld_points.h"
#include "mesh/welded_mesh.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace lsdcd::test_weld {
namespace {

using Triangles = std::vector<std::array<Vec3, 3>>;

TriangleSoup soup_of(const Triangles &triangles)
{
  TriangleSoup soup;
  soup.source = "part.stl";
  for (const auto &t : triangles) soup.corners.insert(soup.corners.end(), t.begin(), t.end());
  return soup;
}

WeldedMesh weld(const Triangles &triangles, Real tolerance = -1)
{
  return lsdcd::weld(soup_of(triangles), tolerance);
}

// Twelve facets, normals out.
Triangles box(const Vec3 &lo, const Vec3 &hi)
{
  const auto corner = [&](int i) {
    return Vec3{i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
  };
  const int sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Triangles out;
  for (const auto &s : sides) {
    out.push_back({corner(s[0]), corner(s[1]), corner(s[2])});
    out.push_back({corner(s[0]), corner(s[2]), corner(s[3])});
  }
  return out;
}

Triangles turned(Triangles triangles)
{
  for (auto &t : triangles) std::swap(t[0], t[1]);
  return triangles;
}

Triangles joined(Triangles a, const Triangles &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Triangles kCube = box({0, 0, 0}, {1, 1, 1});
const Vec3 kA = {0, 0, 0}, kB = {1, 0, 0}, kC = {0, 1, 0}, kD = {0, 0, 1};

TEST(weld, seam_of_a_rounding_error_is_closed_by_default_and_minus_zero_is_zero)
{
  Triangles cube = kCube;
  for (auto &c : cube[4])
    for (int i = 0; i < 3; ++i)
      if (c[i] == 0) c[i] = -0.0;
  EXPECT_EQ(weld(cube, 0).vertices.size(), 8u);
  cube[0][0].x += 5e-17;
  EXPECT_EQ(weld(cube, 0).vertices.size(), 9u);
  cube[3][1].z -= 1e-16;
  EXPECT_EQ(weld(cube).vertices.size(), 8u);
  EXPECT_TRUE(weld(cube).report.closed);
}

TEST(weld, default_tolerance_is_a_millionth_of_the_diagonal)
{
  EXPECT_DOUBLE_EQ(weld(kCube).report.weld_tolerance, 1e-6 * std::sqrt(3.));
}

TEST(weld, a_distance_equal_to_the_tolerance_is_welded)
{
  const Triangles pair = {{kA, kB, kC}, {Vec3{0, 0, -0.25}, kC, kB}};
  EXPECT_EQ(weld(pair, 0.25).vertices.size(), 3u);
  EXPECT_EQ(weld(pair, 0.2499).vertices.size(), 4u);
}

// Clusters of corners at random places, against a search of all pairs.
TEST(weld, points_of_a_random_cloud_agree_with_a_search_of_all_pairs)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> place(-1, 1);
  Triangles cloud;
  for (int i = 0; i < 700; ++i) {
    std::array<Vec3, 3> t;
    for (auto &c : t) c = {place(random), place(random), 0.1 * place(random)};
    cloud.push_back(t);
  }
  const Real tolerance = 0.05;
  const auto mesh = weld(cloud, tolerance);
  std::vector<Vec3> points;    // the greedy choice
  for (const auto &t : cloud)
    for (const auto &c : t)
      if (std::none_of(points.begin(), points.end(),
                       [&](const Vec3 &p) { return norm(p - c) <= tolerance; }))
        points.push_back(c);
  ASSERT_EQ(mesh.vertices.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(mesh.vertices[i], points[i]);
  const auto distance = [&](const Vec3 &c, int v) { return norm(mesh.vertices[v] - c); };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const Vec3 c = cloud[mesh.face_facet[f]][k];
      for (int v = 0; v < static_cast<int>(points.size()); ++v)
        EXPECT_LE(distance(c, mesh.faces[f][k]), distance(c, v));
    }
}

TEST(weld, facets_without_area_leave_edges_and_points_that_no_face_has)
{
  const struct {
    const char *what;
    Triangles triangles;
    std::size_t vertices, edges, faces;
  } rows[] = {{"two points", {{kA, kB, kB}}, 2, 1, 0},
              {"a point", {{kB, kB, kB}}, 1, 0, 0},
              {"a line", {{kA, {0.25, 0, 0}, kB}}, 3, 3, 0},
              {"an edge of a face", {{kA, kB, kC}, {kB, kA, kA}}, 3, 3, 1}};
  for (const auto &row : rows) {
    const auto mesh = weld(row.triangles);
    EXPECT_EQ(mesh.report.degenerate_facets, 1u) << row.what;
    EXPECT_EQ(mesh.vertices.size(), row.vertices) << row.what;
    EXPECT_EQ(mesh.edges.size(), row.edges) << row.what;
    EXPECT_EQ(mesh.faces.size(), row.faces) << row.what;
    EXPECT_EQ(mesh.report.open_edges, 3 * row.faces) << row.what;
  }
  EXPECT_EQ(weld({{kB, kB, kB}}).vertex_first, (std::vector<int>{0, 0}));
}

TEST(weld, points_on_a_line_up_to_rounding_are_collinear)
{
  const Vec3 far = {1000.1, 2000.2, 3000.3}, end = {1001.4, 2000.9, 3000.8};
  for (int i = 1; i < 100; ++i)
    EXPECT_EQ(weld({{far, far + 0.01 * i * (end - far), end}}, 0).report.degenerate_facets, 1u)
        << i;
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> place(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = {place(random), place(random), place(random)};
    const Vec3 b = {place(random), place(random), place(random)};
    EXPECT_EQ(weld({{a, a + 0.3 * (b - a), b}}, 0).report.degenerate_facets, 1u);
  }
}

TEST(weld, a_facet_a_billion_times_longer_than_high_is_a_face)
{
  const auto mesh = weld({{kA, {0.5, 1e-9, 0}, kB}, {kA, kB, {0, -1e-9, 0}}}, 0);
  EXPECT_EQ(mesh.faces.size(), 2u);
  EXPECT_DOUBLE_EQ(mesh.report.smallest_height, 1e-9);
}

TEST(weld, a_small_mesh_has_no_absolute_limit)
{
  Triangles tiny = kCube;
  for (auto &t : tiny)
    for (auto &c : t) c = 1e-60 * c;
  const auto report = weld(tiny).report;
  EXPECT_TRUE(report.oriented);
  EXPECT_DOUBLE_EQ(report.area, 6e-120);
}

TEST(weld, duplicates_of_either_winding_are_dropped)
{
  const auto mesh = weld({{kA, kB, kC}, {kB, kC, kA}, {kC, kB, kA}, {kA, kB, kD}});
  EXPECT_EQ(mesh.report.duplicate_facets, 2u);
  EXPECT_EQ(mesh.report.two_sided_faces, 1u);
  EXPECT_EQ(mesh.face_facet, (std::vector<std::size_t>{0, 3}));
}

TEST(weld, faces_keep_the_winding_of_the_file)
{
  const auto mesh = weld({{kA, kC, kB}});
  EXPECT_EQ(mesh.vertices[mesh.faces[0][1]], kC);
}

// Returns a box of side 1/2 in the middle of the cube.
Triangles inner()
{
  return box({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75});
}

TEST(weld, edges_and_sides_are_those_of_shells)
{
  const Vec3 p = {3, 0, 0}, q = {4, 0, 0}, r = {4, 1, 0}, t = {3, 1, 0};
  const Triangles sheet = {{p, q, t}, {q, r, t}, {p, r, q}, {p, t, r}};    // closed, without volume
  const Triangles fan = {{kA, kB, kC}, {kA, kB, kD}, {kA, kB, {0, -1, 0}}};
  const Triangles beside = box({3, 0, 0}, {4, 1, 1}), touching = box({1, 1, 0}, {2, 2, 1});
  Triangles missing = kCube, facet_turned = kCube;
  missing.pop_back();
  std::swap(facet_turned[5][0], facet_turned[5][1]);
  const struct {
    const char *what;
    Triangles triangles;
    std::size_t open, nonmanifold, misoriented, inverted;
    bool closed, oriented;
  } rows[] = {
      // what, triangles, open, nonmanifold, misoriented, inverted, closed, oriented
      {"a missing facet", missing, 3, 0, 0, 0, false, false},
      {"a turned facet", facet_turned, 0, 0, 3, 0, true, false},
      {"three faces on an edge", fan, 6, 1, 0, 0, false, false},
      {"a bare edge", joined(kCube, {{Vec3{5, 5, 5}, {6, 5, 5}, {7, 5, 5}}}), 0, 0, 0, 0, true,
       true},
      {"a shell wound against another", joined(kCube, turned(beside)), 0, 0, 0, 12, true, false},
      {"shells all inside out", turned(joined(kCube, beside)), 0, 0, 0, 0, true, true},
      {"a cavity", joined(kCube, turned(inner())), 0, 0, 0, 0, true, true},
      {"a cavity wound as its solid", joined(kCube, inner()), 0, 0, 0, 12, true, false},
      {"a solid in a cavity",
       joined(joined(kCube, turned(inner())), box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6})), 0, 0, 0, 0,
       true, true},
      {"a sheet without volume", joined(kCube, sheet), 0, 0, 0, 0, true, true},
      {"that of a cube inside out", joined(turned(kCube), sheet), 0, 0, 0, 0, true, true},
      {"a cube that touches another wound against it", joined(kCube, turned(touching)), 0, 1, 0, 12,
       true, false},
  };
  for (const auto &row : rows) {
    const auto report = weld(row.triangles).report;
    EXPECT_EQ(report.open_edges, row.open) << row.what;
    EXPECT_EQ(report.nonmanifold_edges, row.nonmanifold) << row.what;
    EXPECT_EQ(report.misoriented_edges, row.misoriented) << row.what;
    EXPECT_EQ(report.inverted_facets, row.inverted) << row.what;
    EXPECT_EQ(report.closed, row.closed) << row.what;
    EXPECT_EQ(report.oriented, row.oriented) << row.what;
  }
}

// Its first facets are on a side of the solid: rounding alone would say on which side of that they are.
TEST(weld, a_cavity_that_touches_a_side_of_its_solid_is_one)
{
  for (int k = 0; k < 60; k++) {
    const int axis = k % 3;
    const Real side = k / 3 % 2;
    const Real at = 0.01 * (1 + k);    // of 0.01 to 0.6
    Vec3 lo = {at, 0.9 * at, 0.8 * at}, hi = {at + 0.3, at + 0.25, at + 0.2};
    (side == 0 ? lo : hi)[axis] = side;
    Triangles pit = box(lo, hi);
    std::stable_partition(pit.begin(), pit.end(), [&](const auto &t) {
      return t[0][axis] == side && t[1][axis] == side && t[2][axis] == side;
    });
    Triangles cube = kCube;
    const Real c = std::cos(0.1 * k), sn = std::sin(0.1 * k);
    for (Triangles *some : {&cube, &pit})
      for (auto &t : *some)
        for (Vec3 &p : t) {
          p = {c * p.x - sn * p.y, sn * p.x + c * p.y, p.z};
          p = {p.x, c * p.y - sn * p.z, sn * p.y + c * p.z};
        }
    EXPECT_EQ(weld(joined(cube, pit)).report.inverted_facets, 12u) << k;
    EXPECT_EQ(weld(joined(cube, turned(pit))).report.inverted_facets, 0u) << k;
  }
}

TEST(weld, shells_that_cut_or_touch_each_other_leave_the_mesh_without_sides)
{
  const Triangles two = box({0, 0, 0}, {2, 2, 2});
  const Triangles others[] = {box({1, 1, 1}, {3, 3, 3}),              // cuts
                              box({0.5, 0.5, 0.5}, {1.5, 1.5, 9}),    // goes through a face
                              box({2, 0.5, 0.5}, {3, 1.5, 1.5}),      // touches
                              turned(box({1, 0.5, 0.5}, {2, 1.5, 1.5}))};
  for (const Triangles &other : others) {
    const auto report = weld(joined(two, other)).report;
    EXPECT_GT(report.meeting_pairs, 0u);
    EXPECT_TRUE(report.closed);
    EXPECT_FALSE(report.oriented);
  }
}

TEST(weld, shells_in_each_others_box_that_do_not_meet_keep_the_mesh_oriented)
{
  Triangles ring = box({0, 0, 0}, {4, 4, 1});
  for (auto &t : ring)    // a ramp, over which the other one floats
    for (Vec3 &p : t)
      if (p.x > 2) p.z += 3;
  const auto report = weld(joined(ring, box({0.5, 1, 2.5}, {1.5, 2, 3.5}))).report;
  EXPECT_EQ(report.meeting_pairs, 0u);
  EXPECT_TRUE(report.oriented);
}

TEST(weld, a_shell_that_cuts_itself_is_found_where_it_is_looked_for)
{
  Triangles bad = kCube;
  for (auto &t : bad)
    for (Vec3 &p : t)
      if (norm(p) == 0) p = {2, 0.5, 0.25};    // through the face across
  WeldedMesh mesh = weld(bad);
  EXPECT_TRUE(mesh.report.oriented);
  note_meetings(mesh, meets_itself(mesh));
  EXPECT_GT(mesh.report.meeting_pairs, 0u);
  EXPECT_FALSE(mesh.report.oriented);
}

TEST(weld, volume_far_from_the_origin_keeps_its_digits)
{
  const Real far = 1 << 30;    // corners are exact there
  EXPECT_DOUBLE_EQ(weld(box({far, far, far}, {far + 1, far + 1, far + 1}), 0).report.volume, 1);
  EXPECT_DOUBLE_EQ(weld(turned(kCube)).report.volume, -1);    // its normals point in
}

TEST(weld, fold_is_the_angle_between_face_planes_whatever_the_winding)
{
  const Real slope = std::tan(std::acos(-1.) / 18);    // 10 degrees
  const std::array<Vec3, 3> flat = {kA, kB, {0, -1, 0}};
  EXPECT_NEAR(weld({flat, {kA, kB, {0, 1, slope}}}).report.largest_fold, 10, 1e-13);
  EXPECT_NEAR(weld({flat, {kB, kA, {0, 1, slope}}}).report.largest_fold, 10, 1e-13);
}

TEST(weld, edge_lengths_and_height_of_a_3_4_5_triangle)
{
  const auto report = weld({{kA, {3, 0, 0}, {0, 4, 0}}}).report;
  EXPECT_EQ(report.smallest_edge, 3);
  EXPECT_EQ(report.median_edge, 4);
  EXPECT_EQ(report.largest_edge, 5);
  EXPECT_DOUBLE_EQ(report.smallest_height, 2.4);
}

TriangleSoup floats(const Triangles &triangles)
{
  TriangleSoup soup = soup_of(triangles);
  soup.rounding.step = std::numeric_limits<float>::epsilon();    // as of a binary STL file
  return soup;
}

// A plate of n by m squares of half a metre, from `at` on.
Triangles plate(int n, int m, const Vec3 &at)
{
  Triangles out;
  const auto place = [&](int i, int j) { return at + Vec3{0.5 * i, 0.5 * j, 0}; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      out.push_back({place(i, j), place(i + 1, j), place(i + 1, j + 1)});
      out.push_back({place(i, j), place(i + 1, j + 1), place(i, j + 1)});
    }
  return out;
}

const Vec3 kFarAway = {450000, 5420000, 300};

// The weld of all would be 5 m.
TEST(weld, a_triangle_far_away_takes_nothing_from_a_plate)
{
  const Triangles marked = joined(plate(40, 8, kFarAway), {{kA, kB, kC}});
  const auto report = weld(marked).report;
  EXPECT_EQ(report.degenerate_facets, 0u);
  EXPECT_DOUBLE_EQ(report.area, 80.5);
  EXPECT_DOUBLE_EQ(report.weld_tolerance, 1e-6 * std::sqrt(416.));
}

// 1e-4 wide between plates of 1 m: a part has a weld of 2e-6, and all together of 0.1.
TEST(weld, a_triangle_far_away_closes_no_slit)
{
  const Triangles plates = joined(plate(2, 2, kA), plate(2, 2, {1 + 1e-4, 0, 0}));
  EXPECT_EQ(weld(joined(plates, {{Vec3{1e5, 0, 0}, {1e5, 1, 0}, {1e5, 0, 1}}})).vertices.size(),
            21u);
}

TEST(weld, a_closed_foil_thinner_than_a_millionth_of_its_diagonal_stays_closed)
{
  const auto report = weld(box({-1, -0.7, -5e-7}, {1, 0.7, 5e-7})).report;
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_TRUE(report.oriented);
  EXPECT_NEAR(report.volume, 2.8e-6, 1e-15);    // coordinates of 1 round by 1e-16
}

// Each facet of a plate of 1 m, as floats where these have steps of 7.6e-6, has corners that are off by one step.
Triangles cracked_plate()
{
  std::mt19937 random(4);
  std::uniform_int_distribution<int> side(0, 1);
  Triangles cracked = plate(2, 2, {100.3, 100.3, 100.3});
  for (auto &t : cracked)
    for (auto &c : t)
      for (int i = 0; i < 3; ++i) {
        const float x = static_cast<float>(c[i]);
        c[i] = side(random) ? x : std::nextafter(x, 200.f);
      }
  return cracked;
}

// Placed corners are no floats.
TEST(weld, cracks_as_wide_as_the_steps_of_floats_close_where_the_mesh_is_placed)
{
  TriangleSoup soup = floats(cracked_plate());
  Placement placement;
  placement.move({-100.3, -100.3, -100.3});
  placement.scale({0.001, 0.001, 0.001});
  placement.rotate({1, 2, 3}, 40);
  placement.apply(soup);
  EXPECT_EQ(lsdcd::weld(soup, -1).vertices.size(), 9u);
}

// Off by 4e-7 of the plate at most, where a facet alone would have a weld of 2e-8 of it.
TEST(weld, a_fine_mesh_that_is_cracked_everywhere_closes)
{
  const int n = 60;
  std::mt19937 random(9);
  std::uniform_real_distribution<Real> jitter(-5e-6, 5e-6);
  Triangles cracked = plate(n, n, kA);
  for (auto &t : cracked)
    for (auto &c : t) c += Vec3{jitter(random), jitter(random), jitter(random)};
  const auto report = weld(cracked).report;
  EXPECT_EQ(report.vertices, std::size_t(n + 1) * (n + 1));
  EXPECT_EQ(report.open_edges, 4u * n);
  EXPECT_EQ(report.degenerate_facets, 0u);
}

// An edge of 1e-6 between two facets of 2 m, and their seam is off by 2e-7 there.
TEST(weld, an_edge_shorter_than_a_millionth_of_the_mesh_stays)
{
  const Real s = 1e-6, off = 2e-7;
  const Triangles seam = {
      {kA, Vec3{s, 0, 0}, kD}, {kA, kD, {0, -2, 0}}, {Vec3{s, off, 0}, Vec3{0, off, 0}, kC}};
  const auto mesh = weld(seam);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.report.open_edges, 5u);
  EXPECT_EQ(mesh.report.closed_cracks, 2u);
  EXPECT_DOUBLE_EQ(mesh.report.widest_crack, off);
}

// Floats have steps of 0.5 m there.
TEST(weld, facets_as_small_as_the_steps_of_floats_stay_and_are_named)
{
  const auto report = lsdcd::weld(floats(plate(40, 8, kFarAway)), -1).report;
  EXPECT_DOUBLE_EQ(report.area, 80);
  EXPECT_EQ(report.coarse_corners, 96u);
  EXPECT_TRUE(has(weld_warning(report), "96 corners on open edges"));
  EXPECT_EQ(weld_warning(weld(plate(40, 8, kFarAway)).report), "");    // doubles have finer ones
}

TEST(weld, points_of_one_copy_stay_apart)
{
  const std::vector<Vec3> points = {{0, 0, 0},      {0, 0, 1e-7},  {1, 0, 0},
                                    {0, 0, 1.1e-7}, {0, 0, -1e-9}, {5, 0, 0}};
  EXPECT_EQ(weld_copies(points, {0, 3}, 1e-6).corner_point, (std::vector<int>{0, 1, 2, 1, 0, 3}));
}

TEST(weld, two_cubes_that_touch_along_an_edge_are_closed)
{
  const Triangles two = joined(kCube, box({1, 1, 0}, {2, 2, 1}));
  const auto report = weld(two).report;
  EXPECT_EQ(report.nonmanifold_edges, 1u);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.oriented);
  EXPECT_DOUBLE_EQ(report.volume, 2);
  EXPECT_TRUE(has(describe(report, ""), "closed, normals point out; solids touch along 1 edge"));
}

// Each cube of a chessboard touches others along all of its edges, so that no two faces of a cube share an edge alone.
TEST(weld, cubes_that_touch_along_all_their_edges_are_closed)
{
  Triangles board;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        if ((i + j + k) % 2 == 0)
          board = joined(board, box({1. * i, 1. * j, 1. * k}, {i + 1., j + 1., k + 1.}));
  const auto report = weld(board).report;
  EXPECT_TRUE(report.oriented);
  EXPECT_DOUBLE_EQ(report.volume, 32);
}

// The inner prism has an edge of the outer one, and slanted ends.
TEST(weld, solids_that_share_an_edge_and_overlap_have_no_sides)
{
  const auto prism = [](const Vec3 &p, const Vec3 &q, Real lower) {
    const Vec3 up = {0, 0, 1}, a = kA, b = p + Vec3{0, 0, lower}, c = q + Vec3{0, 0, lower}, d = up,
               e = p + Vec3{0, 0, 1 - lower}, f = q + Vec3{0, 0, 1 - lower};
    return Triangles{{a, c, b}, {d, e, f}, {a, b, e}, {a, e, d},
                     {b, c, f}, {b, f, e}, {c, a, d}, {c, d, f}};
  };
  const Triangles outer = prism({4, -3, 0}, {4, 3, 0}, 0),
                  inner = prism({1, -0.5, 0}, {1, 0.5, 0}, 0.2);
  EXPECT_TRUE(weld(outer).report.oriented);
  EXPECT_TRUE(weld(inner).report.oriented);
  EXPECT_FALSE(weld(joined(outer, inner)).report.oriented);
}

TEST(weld, three_facets_at_an_edge_are_not_closed)
{
  const Triangles with_wall = joined(kCube, {{kA, {1, 1, 0}, {1, 1, 1}}, {kA, {1, 1, 1}, kD}});
  const auto report = weld(with_wall).report;
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_FALSE(report.closed);
  EXPECT_TRUE(has(describe(report, ""), "surface     not closed"));
}

std::string error_of(const Triangles &triangles, Real tolerance = -1)
{
  return lsdcd::error_of([&] { weld(triangles, tolerance); });
}

TEST(weld, what_is_no_mesh_is_refused)
{
  EXPECT_TRUE(has(error_of({}), "part.stl: the mesh has no facets"));
  EXPECT_TRUE(has(error_of(kCube, 2), "weld tolerance of 2"));
  EXPECT_NE(error_of(kCube, NAN), "");
  EXPECT_TRUE(has(error_of({{kA, {1e-200, 0, 0}, {0, 1e-200, 0}}}), "larger scale"));
  for (const Real bad : {Real(NAN), Real(INFINITY), 1e200}) {
    auto cube = kCube;
    cube[3][1].y = bad;
    EXPECT_TRUE(has(error_of(cube), "part.stl, facet 4: coordinate y"));
  }
}

TEST(weld, a_tolerance_that_takes_away_a_part_of_the_area_is_refused)
{
  const std::string error = error_of(plate(40, 8, kA), 0.6);
  EXPECT_TRUE(has(error, "takes away"));
  EXPECT_TRUE(has(error, "of 640 facets"));
}

// A sliver of 1e-7 by 1 in a cube of 6.
TEST(weld, a_sliver_that_a_tolerance_takes_away_is_told)
{
  Triangles cube = kCube;
  const Vec3 beside = {1e-7, 0, 0};
  cube.push_back({kA, beside, kD});
  const auto report = weld(cube, 1e-6).report;
  EXPECT_EQ(report.collapsed_facets, 1u);
  EXPECT_DOUBLE_EQ(report.collapsed_area, 5e-8);
  EXPECT_TRUE(has(describe(report, ""), "collapsed   1 facet of the degenerate ones"));
}

TEST(weld, more_edges_than_an_int_numbers_the_ends_of_are_refused)
{
  EXPECT_NO_THROW(check_edge_number((1u << 30) - 1, "part.stl"));
  EXPECT_THROW(check_edge_number(1u << 30, "part.stl"), InputError);
}

TEST(inspect, description_of_a_cube)
{
  const auto report = weld(kCube, 1e-5).report;
  EXPECT_EQ(describe(report, "cube.stl"),
            "mesh cube.stl\n"
            "  facets      12, 0 degenerate and 0 duplicates dropped\n"
            "  vertices    8, welded from 36 corners (tolerance 1e-05)\n"
            "  edges       18, 0 open, 0 non-manifold, 0 misoriented\n"
            "  surface     closed, normals point out\n"
            "  area        6\n"
            "  volume      1\n"
            "  box         (0, 0, 0) to (1, 1, 1)\n"
            "  edge length 1 smallest, 1 median, 1.41421 largest\n"
            "  thinnest    face 0.707107 high\n"
            "  folds       90 degrees at most, 12 edges above 30");
}

TEST(inspect, an_open_mesh_shows_no_volume)
{
  const auto block = describe(weld({{kA, kB, kC}}).report, "sheet.stl");
  EXPECT_TRUE(has(block, "surface     open"));
  EXPECT_FALSE(has(block, "volume"));
}

TEST(fingerprint, sees_the_last_bit_of_a_vertex)
{
  const std::uint64_t whole = fingerprint(weld(kCube));
  EXPECT_EQ(fingerprint(weld(kCube)), whole);
  WeldedMesh cube = weld(kCube);
  for (Vec3 &v : cube.vertices)
    for (int d = 0; d < 3; d++) {
      const Real was = v[d];
      v[d] = std::nextafter(was, 2.);
      EXPECT_NE(fingerprint(cube), whole);
      v[d] = was;
    }
}

TEST(fingerprint, sees_the_order_and_the_winding_of_faces)
{
  Triangles turned = kCube, swapped = kCube;
  std::swap(turned.back()[1], turned.back()[2]);
  std::swap(swapped[10], swapped[11]);
  EXPECT_NE(fingerprint(weld(turned)), fingerprint(weld(kCube)));
  EXPECT_NE(fingerprint(weld(swapped)), fingerprint(weld(kCube)));
}

}    // namespace
}    // namespace lsdcd::test_weld
