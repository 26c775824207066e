// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The library through its headers, against brute force over the bare triangles.
#include "points_and_meshes.h"
#include "support/comma_locale.h"
#include "support/query_oracle.h"
#include "support/temp_dir.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <thread>

// The library's calls of dlopen() come here: it takes microseconds, and a query should take less.
static std::atomic<int> n_dlopens{0};
extern "C" __attribute__((visibility("default"))) void *dlopen(const char *file, int mode)
{
  n_dlopens++;
  return reinterpret_cast<void *(*) (const char *, int)>(dlsym(RTLD_NEXT, "dlopen"))(file, mode);
}

namespace test_library {
namespace {

using lsdcd::TriangleSoup;
using lsdcd::Vec3;

constexpr double kCutoff = 0.4;

double distance_to(const TriangleSoup &soup, std::size_t triangle, const Vec3 &q)
{
  const Vec3 *c = &soup.corners[3 * triangle];
  return std::sqrt(lsdcd::region_distance_sq(c[0], c[1], c[2], q));
}
double brute(const TriangleSoup &soup, const Vec3 &q)
{
  double least = HUGE_VAL;
  for (std::size_t t = 0; t < soup.n_triangles(); t++)
    least = std::min(least, distance_to(soup, t, q));
  return least;
}

template <class T>
struct All {
  std::vector<T> distance, closest, normal;
  std::vector<std::uint32_t> triangle, feature;
  std::vector<std::int8_t> side;
  std::vector<std::uint8_t> status;

  All(const lsdcd::Grid &grid, const std::vector<T> &points, bool sides = false,
      double radius = 0) :
      distance(points.size() / 3),
      closest(points.size()), normal(points.size()), triangle(distance.size()),
      feature(distance.size()), side(distance.size()), status(distance.size())
  {
    lsdcd::Query<T> q(points.data(), distance.size());
    q.radius = radius;
    q.distance = distance.data();
    q.closest = closest.data();
    q.normal = normal.data();
    q.triangle = triangle.data();
    q.feature = feature.data();
    if (sides) q.side = side.data();
    q.status = status.data();
    grid.query(q);
  }
};

lsdcd::Grid grid_of(const TriangleSoup &soup, int nearest = 0, int precision = LSDCD_DOUBLE)
{
  lsdcd::GridOptions options(kCutoff);
  options.nearest = nearest;
  options.precision = precision;
  return lsdcd::Grid(lsdcd::Mesh(numbers(soup)), options);
}

// Certified answers are those of brute force. `tolerance`: the rounding of coordinates up to 1.5 in
// T and in the search, some 16 units of it, and the mesh's own tolerance, 1e-9 of lengths of order 1.
template <class T>
void expect_nearest(const lsdcd::Grid &grid, const TriangleSoup &soup, double tolerance,
                    bool all_certified)
{
  const std::vector<T> points = random_points<T>(4000);
  const All<T> a(grid, points);
  std::size_t found = 0;
  for (std::size_t i = 0; i < a.status.size(); i++) {
    const Vec3 q = point(points, i);
    const double truth = brute(soup, q);
    EXPECT_TRUE(!all_certified || (a.status[i] & LSDCD_CERTIFIED)) << i;
    const bool is = a.status[i] & LSDCD_FOUND;
    EXPECT_EQ(is, std::isfinite(a.distance[i])) << i;
    EXPECT_EQ(is, a.triangle[i] != LSDCD_NONE) << i;
    EXPECT_EQ(is, a.feature[i] != LSDCD_NONE) << i;
    found += is;
    if (a.status[i] & LSDCD_CERTIFIED) {
      if (is)
        EXPECT_NEAR(a.distance[i], truth, tolerance) << i;
      else
        EXPECT_GE(truth, kCutoff - tolerance) << i;
    }
    const Vec3 c = point(a.closest, i), n = point(a.normal, i);
    if (!is) {
      EXPECT_TRUE(c == q && norm(n) == 0) << i;
      continue;
    }
    // Certified or not, what is said of the triangle is true.
    ASSERT_LT(a.triangle[i], soup.n_triangles());
    EXPECT_NEAR(norm(q - c), a.distance[i], tolerance) << i;
    EXPECT_NEAR(distance_to(soup, a.triangle[i], c), 0, tolerance) << i;
    EXPECT_NEAR(norm(n), 1, 4 * tolerance) << i;
    EXPECT_NEAR(norm(c + a.distance[i] * n - q), 0, 2 * tolerance) << i;
  }
  EXPECT_GT(found, a.status.size() / 4);
}

constexpr double kInDouble = 1e-8, kInFloat = 4e-6;

TEST(library, its_version_is_that_of_its_header)
{
  const auto text = [](int n) { return std::to_string(n); };
  EXPECT_EQ(lsdcd_version(), text(LSDCD_VERSION_MAJOR) + "." + text(LSDCD_VERSION_MINOR) + "." +
                                 text(LSDCD_VERSION_PATCH));
}

TEST(library, answers_are_those_of_brute_force)
{
  const TriangleSoup soup = box_and_cylinder();
  for (const int nearest : {0, 2})
    for (const int precision : {LSDCD_DOUBLE, LSDCD_FLOAT}) {
      const lsdcd::Grid grid = grid_of(soup, nearest, precision);
      expect_nearest<double>(grid, soup, precision == LSDCD_DOUBLE ? kInDouble : kInFloat,
                             nearest == 0);
      expect_nearest<float>(grid, soup, kInFloat, nearest == 0);
    }
}

// Points within twice the float tolerance of an edge's own plane, at any height over it: where a
// float decides wrongly which feature is nearest.
std::vector<double> points_at_edges(const TriangleSoup &soup, double tolerance, std::size_t n)
{
  std::mt19937 r(5);
  std::uniform_real_distribution<double> part(0, 1), off(-2 * tolerance, 2 * tolerance),
      digits(-8, 0);
  std::uniform_int_distribution<std::size_t> which(0, soup.corners.size() - 1);
  std::vector<double> points;
  for (std::size_t i = 0; i < n; i++) {
    const std::size_t k = which(r), first = k / 3 * 3;
    const Vec3 a = soup.corners[k], b = soup.corners[first + (k + 1) % 3],
               c = soup.corners[first + (k + 2) % 3];
    const Vec3 normal = cross(b - a, c - a), up = (1 / norm(normal)) * normal;
    const Vec3 across = (1 / norm(b - a)) * cross(b - a, up);
    const Vec3 q = a + (i % 4 ? part(r) : 0.) * (b - a) + off(r) * across +
                   (kCutoff * std::pow(10., digits(r))) * up;
    points.insert(points.end(), {q.x, q.y, q.z});
  }
  return points;
}

// The bound of doc/theory.md, "Floats": three tolerances of 16 units of float rounding of cutoff + 14 cells.
TEST(library, a_search_in_float_is_off_by_its_bound_at_most_at_edges_too)
{
  const TriangleSoup soup = box_and_cylinder();
  double largest = 0;
  for (const double cell : {0.1 * kCutoff, kCutoff}) {
    lsdcd::GridOptions options(kCutoff);
    options.precision = LSDCD_FLOAT;
    options.cell = cell;
    const lsdcd::Grid grid(lsdcd::Mesh(numbers(soup)), options);
    const double bound = 3e-6 * (kCutoff + 14 * cell);
    const std::vector<double> points = points_at_edges(soup, bound / 3, 20000);
    const All<double> a(grid, points);
    for (std::size_t i = 0; i < a.status.size(); i++) {
      const Vec3 q = point(points, i);
      const double truth = brute(soup, q);
      if (!(a.status[i] & LSDCD_FOUND)) {
        ASSERT_GE(truth, kCutoff - bound) << i;
        continue;
      }
      ASSERT_NEAR(a.distance[i], truth, bound) << i;
      ASSERT_NEAR(norm(q - point(a.closest, i)), truth, bound) << i;
      largest = std::max(largest, std::fabs(a.distance[i] - truth) / bound);
    }
  }
  EXPECT_GT(largest, 0.2);    // some points are where a float picks the other feature
}

TEST(library, the_side_is_that_of_the_box)
{
  const TriangleSoup box = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1});
  for (int nearest : {0, 1})
    for (int precision : {LSDCD_DOUBLE, LSDCD_FLOAT}) {
      const lsdcd::Grid grid = grid_of(box, nearest, precision);
      std::vector<double> points = random_points<double>(20000);
      // Some within 1e-9 of a wall, where a float cannot tell.
      for (std::size_t i = 0; i < 300; i++) points[3 * i] = 1 + (i % 2 ? 1e-9 : -1e-9);
      const All<double> a(grid, points, true);
      std::size_t inside = 0, wrong = 0;
      for (std::size_t i = 0; i < a.side.size(); i++) {
        const Vec3 q = point(points, i);
        const bool in = std::max({std::fabs(q.x), std::fabs(q.y), std::fabs(q.z)}) < 1;
        inside += a.side[i] < 0;
        wrong += a.side[i] != (in ? -1 : 1);
      }
      EXPECT_EQ(wrong, 0u) << "nearest " << nearest << " precision " << precision;
      EXPECT_GT(inside, 100u);
    }
}

TEST(library, sides_are_known_where_nothing_is_found)
{
  const lsdcd::Grid grid(lsdcd::Mesh(numbers(lsdcd::box_mesh({0, 0, 0}, {9, 9, 9}))), 0.1);
  const double no = std::nan("");
  const All<double> a(grid, {4, 4, 4, 4, 4, 12, 1e30, 4, 4, no, 4, 4}, true);
  EXPECT_EQ(a.side, (std::vector<std::int8_t>{-1, 1, 1, 0}));
  EXPECT_EQ(a.status[0] & LSDCD_FOUND, 0);
}

TEST(library, facts_tell_of_shells_that_cut_each_other)
{
  TriangleSoup soup = lsdcd::box_mesh({0, 0, 0}, {2, 2, 2});
  EXPECT_EQ(lsdcd::Mesh(numbers(soup)).facts().meeting_pairs, 0u);
  lsdcd::append(soup, lsdcd::box_mesh({1, 1, 1}, {3, 3, 3}));
  EXPECT_GT(lsdcd::Mesh(numbers(soup)).facts().meeting_pairs, 0u);
}

TEST(library, a_shell_that_cuts_itself_has_sides_from_a_cache_too)
{
  TriangleSoup soup = lsdcd::box_mesh({0, 0, 0}, {1, 1, 1});
  for (Vec3 &p : soup.corners)
    if (norm(p) == 0) p = {2, 0.5, 0.25};    // through the face across
  lsdcd::TempDir folder;
  const std::string file = folder.path("grid.cache");
  const lsdcd::Mesh mesh(numbers(soup));
  for (const bool again : {false, true}) {
    lsdcd::GridOptions options(kCutoff);
    options.cache = file.c_str();
    const lsdcd::Grid grid(mesh, options);
    EXPECT_EQ(bool(grid.facts().from_cache), again);
    EXPECT_TRUE(grid.facts().has_sides);
    EXPECT_TRUE(lsdcd::has(grid.report(), "sides on the host alone"));
    // In the box, where its corner was, in the part that came out, and beside that.
    const All<double> a(grid, {0.9, 0.9, 0.9, 0.05, 0.05, 0.05, 1.1, 0.45, 0.25, 1.5, 0.9, 0.9},
                        true);
    EXPECT_EQ(a.side, (std::vector<std::int8_t>{-1, 1, -1, 1}));
  }
}

// A face that two boxes share, and edges of triangles without area.
TEST(library, the_side_on_the_mesh_is_1_also_where_both_sides_are_inside)
{
  TriangleSoup soup = lsdcd::box_mesh({0, 0, 0}, {1, 1, 1});
  TriangleSoup right = soup;
  for (Vec3 &x : right.corners) x.x = 2 - x.x;    // the mirror image turns windings
  for (std::size_t t = 0; t < right.corners.size(); t += 3)
    std::swap(right.corners[t], right.corners[t + 1]);
  lsdcd::append(soup, right);
  soup.corners.insert(soup.corners.end(), {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {0.5, 0.5, 0.5}});
  const std::vector<double> on = {1, 0.25, 0.5, 1, 0.5, 0.5, 1, 0.75, 0.125, 0.5, 0.5, 0.5},
                            off = {0.875, 0.25, 0.5, 1.125, 0.5, 0.5, 0.5, 0.5, 0.625};
  std::vector<lsdcd::Grid> grids;
  grids.emplace_back(lsdcd::Mesh(numbers(soup)));
  grids.push_back(grid_of(soup, 4));
  grids.push_back(grid_of(soup, 0, LSDCD_FLOAT));
  for (const lsdcd::Grid &grid : grids) {
    const All<double> at(grid, on, true), beside(grid, off, true);
    // By cells in float they are within 3e-6 (cutoff + 14 cells).
    for (const double distance : at.distance) EXPECT_LE(distance, &grid == &grids[2] ? 1e-5 : 0);
    EXPECT_EQ(at.side, std::vector<std::int8_t>(4, 1));
    EXPECT_EQ(beside.side, std::vector<std::int8_t>(3, -1));
  }
}

// A cube without its face at x = 1, seen from its middle, is five sixths of all.
template <class T>
void expect_estimated(int precision)
{
  TriangleSoup soup = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1}), open;
  for (std::size_t t = 0; t < soup.corners.size(); t += 3) {
    const Vec3 *c = &soup.corners[t];
    if (c[0].x + c[1].x + c[2].x < 3) open.corners.insert(open.corners.end(), c, c + 3);
  }
  const lsdcd::Grid grid = grid_of(open, 0, precision);
  EXPECT_FALSE(grid.facts().has_sides);
  const std::vector<T> points = {0, 0, 0, T(0.9), 0, 0, 2, 0, 0, -1, 0, 0, T(std::nan("")), 0, 0};
  std::vector<T> winding(10);
  std::vector<std::int8_t> side(5);
  std::vector<std::uint8_t> status(5);
  lsdcd::Query<T> q(points.data(), 5);
  q.winding = winding.data();
  q.winding_step = 2;
  q.side = side.data();
  q.status = status.data();
  q.estimate_sides = true;
  grid.query(q);
  const double rounding = sizeof(T) == sizeof(float) ? 1e-7 : 1e-15;
  EXPECT_NEAR(winding[0], 5. / 6, rounding);
  EXPECT_TRUE(std::isnan(winding[8]));
  EXPECT_EQ(side, (std::vector<std::int8_t>{-1, -1, 1, 1, 0}));
  for (const std::uint8_t s : status) EXPECT_TRUE(s & LSDCD_SIDE_ESTIMATED);
}

TEST(library, sides_of_an_open_mesh_are_estimated_where_that_is_asked_for)
{
  for (const int precision : {LSDCD_DOUBLE, LSDCD_FLOAT}) {
    expect_estimated<double>(precision);
    expect_estimated<float>(precision);
  }
}

TEST(library, sides_of_a_closed_mesh_are_never_estimated)
{
  const lsdcd::Grid grid = grid_of(lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1}));
  const double points[] = {0, 0, 0, 1, 0, 0, 1.5, 0, 0};
  double winding[3];
  std::int8_t side[3];
  std::uint8_t status[3];
  lsdcd::Query<double> q(points, 3);
  q.winding = winding;
  q.side = side;
  q.status = status;
  q.estimate_sides = true;
  grid.query(q);
  const double wanted[] = {1, 0.5, 0};
  for (int i = 0; i < 3; i++) {
    EXPECT_NEAR(winding[i], wanted[i], 1e-15);
    EXPECT_EQ(side[i], i == 0 ? -1 : 1);
    EXPECT_FALSE(status[i] & LSDCD_SIDE_ESTIMATED);
  }
}

// A query of doubles takes no array of floats, nor the other way round.
template <class T, class U, class = void>
struct TakesArrays : std::false_type {
};
template <class T, class U>
struct TakesArrays<
    T, U,
    std::void_t<decltype(std::declval<lsdcd::Query<T> &>().distance = static_cast<U *>(nullptr))>> :
    std::true_type {
};
TEST(library, a_query_in_cpp_takes_arrays_of_its_type_only)
{
  EXPECT_TRUE((TakesArrays<double, double>::value && TakesArrays<float, float>::value));
  EXPECT_FALSE((TakesArrays<double, float>::value || TakesArrays<float, double>::value));
  EXPECT_FALSE((TakesArrays<double, void>::value || TakesArrays<float, void>::value));
}

// A box whose triangles come in any order; points on a lattice are as near to two, three or more of them.
// Coordinates and most distances are exact there, and those that differ do so by more than 0.01.
class Ties : public ::testing::Test {
 protected:
  static TriangleSoup shuffled_box()
  {
    const TriangleSoup box = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1});
    std::vector<std::size_t> order(box.n_triangles());
    for (std::size_t t = 0; t < order.size(); t++) order[t] = t;
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    TriangleSoup soup;
    for (const std::size_t t : order)
      soup.corners.insert(soup.corners.end(), &box.corners[3 * t], &box.corners[3 * t] + 3);
    return soup;
  }
  static std::vector<double> lattice()
  {
    std::vector<double> points;
    for (int i = 0; i < 11 * 11 * 11; i++)
      for (const int k : {i % 11, i / 11 % 11, i / 121}) points.push_back(0.25 * (k - 5));
    return points;
  }
  const TriangleSoup soup = shuffled_box();
  const lsdcd::Mesh mesh{numbers(soup)};
  const std::vector<double> points = lattice();
};

TEST_F(Ties, give_the_lowest_triangle_whatever_the_cutoff)
{
  std::vector<std::uint32_t> lowest;
  for (std::size_t i = 0; i < points.size() / 3; i++) {
    const double least = brute(soup, point(points, i));
    lowest.push_back(0);
    while (distance_to(soup, lowest[i], point(points, i)) > least + 1e-9) lowest[i]++;
  }
  for (const int nearest : {0, 4})
    for (const double cutoff : {0., 0.3, 0.55, 1.1, 1.7, 4., 4e3}) {
      if (nearest > 0 && (cutoff == 0 || cutoff > 4))
        continue;    // cells have a cutoff of some sizes
      lsdcd::GridOptions options(cutoff);
      options.nearest = nearest;
      const All<double> a(lsdcd::Grid(mesh, options), points);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < lowest.size(); i++)
        wrong += a.status[i] == (LSDCD_FOUND | LSDCD_CERTIFIED) && a.triangle[i] != lowest[i];
      EXPECT_EQ(wrong, 0u) << "cutoff " << cutoff << " nearest " << nearest;
    }
}

TEST_F(Ties, give_the_same_closest_point_whatever_the_cutoff)
{
  const All<double> far(lsdcd::Grid(mesh), points);
  const double diagonal = 2 * std::sqrt(3.);
  for (const double cutoff : {1e-3 * diagonal, 1.1, diagonal, 1e3 * diagonal}) {
    const All<double> near(lsdcd::Grid(mesh, cutoff), points, true);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < near.status.size(); i++) {
      wrong += (near.status[i] & LSDCD_FOUND) != (far.distance[i] < cutoff);
      if (near.status[i] & LSDCD_FOUND)
        wrong += near.feature[i] != far.feature[i] || near.distance[i] != far.distance[i] ||
                 !(point(near.closest, i) == point(far.closest, i)) ||
                 !(point(near.normal, i) == point(far.normal, i));
    }
    EXPECT_EQ(wrong, 0u) << cutoff;
  }
}

// From so far the mesh is a point: the distance is that to the origin, up to a few roundings.
TEST(library, a_point_beyond_1e154_has_its_distance)
{
  for (const double scale : {1e-100, 1., 1e99}) {
    TriangleSoup soup = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1});
    for (Vec3 &corner : soup.corners) corner = scale * corner;
    const lsdcd::Grid grid(lsdcd::Mesh(numbers(soup)));
    const std::vector<double> points = {1e154, 1e154,  1e154, 1e300, 0,      0,     0, 1.7e308,
                                        0,     -5e307, 1e307, 5e307, -1e307, 1e200, 5};
    const std::vector<double> distance = grid.distances(points);
    for (std::size_t i = 0; i < distance.size(); i++) {
      const double wanted = std::hypot(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      EXPECT_NEAR(distance[i] / wanted, 1, 1e-14) << scale << " " << i;
    }
    EXPECT_EQ(grid.distances(points, 1e200)[1], HUGE_VAL);
  }
}

TEST(library, a_point_that_is_no_number_is_far)
{
  const std::vector<double> points = {NAN, 0, 0, HUGE_VAL, 1, 1, 1, -HUGE_VAL, 1};
  const All<double> a(grid_of(box_and_cylinder()), points);
  for (int i = 0; i < 3; i++) EXPECT_EQ(a.distance[i], HUGE_VAL);
}

// A cube of side 2 about 0; vertex v has the coordinate 1 along axis a where bit a of v is set.
const std::vector<std::uint32_t> kCubeFaces = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6,
                                               0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                               0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
template <class T>
std::vector<T> cube_vertices()
{
  std::vector<T> at;
  for (int v = 0; v < 8; v++)
    for (int a = 0; a < 3; a++) at.push_back(v >> a & 1 ? 1 : -1);
  return at;
}

TEST(library, a_mesh_of_vertices_and_faces_is_that_of_its_corners)
{
  std::vector<double> corners;
  for (const std::uint32_t v : kCubeFaces)
    for (int a = 0; a < 3; a++) corners.push_back(cube_vertices<double>()[3 * v + a]);
  const lsdcd::MeshArrays a = lsdcd::Mesh(corners).arrays();
  const lsdcd::MeshArrays b[] = {lsdcd::Mesh(cube_vertices<double>(), kCubeFaces).arrays(),
                                 lsdcd::Mesh(cube_vertices<float>(), kCubeFaces).arrays()};
  for (const lsdcd::MeshArrays &m : b) {
    EXPECT_EQ(m.vertices, a.vertices);
    EXPECT_EQ(m.faces, a.faces);
    EXPECT_EQ(m.edges, a.edges);
  }
}

// Each corner of the cube is there three times, a little apart, for a face each; the last vertex has no face.
TEST(library, given_vertices_have_the_welded_one_that_they_became)
{
  const double weld = 1e-3;
  std::vector<double> vertices;
  std::mt19937 r(3);
  std::uniform_real_distribution<double> off(-weld / 4, weld / 4);    // so less than `weld` apart
  for (int copy = 0; copy < 3; copy++)
    for (const double x : cube_vertices<double>()) vertices.push_back(x + off(r));
  vertices.insert(vertices.end(), {0, 0, 0});
  std::vector<std::uint32_t> faces = kCubeFaces;
  for (std::size_t k = 0; k < faces.size(); k++) faces[k] += 8 * ((k / 3) % 3);
  std::vector<char> has_face(25, 0);
  for (const std::uint32_t v : faces) has_face[v] = 1;
  const lsdcd::Mesh mesh(vertices, faces, weld);
  const lsdcd::MeshArrays m = mesh.arrays();
  ASSERT_EQ(mesh.facts().given_vertices, 25u);
  ASSERT_EQ(mesh.facts().vertices, 8u);
  ASSERT_EQ(m.welded_vertex.size(), 25u);
  for (std::size_t v = 0; v < 25; v++) {
    if (!has_face[v]) {
      EXPECT_EQ(m.welded_vertex[v], LSDCD_NONE) << v;
      continue;
    }
    ASSERT_LT(m.welded_vertex[v], 8u) << v;
    EXPECT_LE(norm(point(m.vertices, m.welded_vertex[v]) - point(vertices, v)), weld) << v;
  }
  for (std::size_t k = 0; k < faces.size(); k++)
    EXPECT_EQ(m.welded_vertex[faces[k]], m.faces[3 * m.welded_face[k / 3] + k % 3]) << k;
}

// Six vertices: the first and the fourth are at one place, but for the sign of a zero; the fifth is of no face.
TEST(library, vertices_of_a_file_have_the_welded_one_that_they_became)
{
  const std::string places[] = {"0 0 0", "1 0 0", "1 1 0", "-0 0 0", "5 5 5", "0 1 0"};
  std::string obj, lines;
  for (const std::string &at : places) {
    obj += "v " + at + "\n";
    lines += at + "\n";
  }
  const std::pair<const char *, std::string> files[] = {
      {"m.obj", obj + "f 1 2 3 6\nf 4 3 6\n"},
      {"m.off", "OFF\n6 2 0\n" + lines + "4 0 1 2 5\n3 3 2 5\n"},
      {"m.ply",
       "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty "
       "double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n" +
           lines + "4 0 1 2 5\n3 3 2 5\n"}};
  const lsdcd::TempDir folder;
  for (const auto &[name, text] : files) {
    const lsdcd::Mesh mesh(folder.write(name, text));
    const lsdcd::MeshArrays m = mesh.arrays();
    ASSERT_EQ(mesh.facts().given_vertices, 6u) << name;
    const std::uint32_t *v = m.welded_vertex.data();
    EXPECT_EQ(v[4], LSDCD_NONE) << name;
    EXPECT_EQ(v[3], v[0]) << name;
    for (const int k : {0, 1, 2, 3, 5}) {
      const Vec3 wanted = {k == 1 || k == 2 ? 1. : 0., k == 2 || k == 5 ? 1. : 0., 0};
      EXPECT_EQ(point(m.vertices, v[k]), wanted) << name << " " << k;
    }
    // The square is two triangles, the second of which the last one repeats.
    EXPECT_EQ(m.welded_face, (std::vector<std::uint32_t>{0, 1, 1})) << name;
  }
}

TEST(library, given_triangles_have_their_face_or_that_of_their_double_or_none)
{
  const std::vector<double> vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 0, 0};
  const std::vector<std::uint32_t> faces = {
      0, 1, 4,    // a line
      0, 1, 2,    // face 0
      1, 1, 3,    // a line
      0, 2, 3,    // face 1
      2, 0, 1,    // face 0 again
      3, 2, 0,    // face 1, wound the other way
      3, 3, 3,    // a point
      0, 1, 3,    // face 2
  };
  const std::uint32_t none = LSDCD_NONE;
  const lsdcd::MeshArrays m = lsdcd::Mesh(vertices, faces).arrays();
  EXPECT_EQ(m.welded_face, (std::vector<std::uint32_t>{none, 0, none, 1, 0, 1, none, 2}));
  EXPECT_EQ(m.triangle, (std::vector<std::uint32_t>{1, 3, 7}));
}

// Until 1.0 a struct has the size that the library's header gives it: another one is of another version.
TEST(library, structs_of_another_size_are_refused)
{
  const lsdcd::Mesh mesh(cube_vertices<double>(), kCubeFaces);
  const lsdcd::Grid grid(mesh);
  const double point[] = {0, 0, 0};
  double distance = 7;
  for (const int more : {-8, 8}) {
    const auto is_refused = [&](auto given, const auto &call) {
      const std::size_t right = given.size;
      given.size += more;
      EXPECT_EQ(call(&given), LSDCD_ERROR_ARGUMENT);
      EXPECT_TRUE(lsdcd::says(lsdcd_last_error(),
                              {"size is " + std::to_string(given.size) + ", and should be sizeof(",
                               "), " + std::to_string(right) + ":"}));
    };
    lsdcd_mesh_facts facts = {};
    facts.size = sizeof facts;
    is_refused(facts, [&](auto *f) { return lsdcd_mesh_get_facts(mesh.get(), f); });
    lsdcd_mesh_arrays arrays = {};
    arrays.size = sizeof arrays;
    is_refused(arrays, [&](auto *f) { return lsdcd_mesh_get_arrays(mesh.get(), f); });
    lsdcd_grid_facts of_grid = {};
    of_grid.size = sizeof of_grid;
    is_refused(of_grid, [&](auto *f) { return lsdcd_grid_get_facts(grid.get(), f); });
    lsdcd_query q = lsdcd::Query<double>(point, 1);
    q.distance = &distance;
    is_refused(q, [&](auto *f) { return lsdcd_query_host(grid.get(), f); });
    lsdcd_grid_options options = lsdcd::GridOptions();
    is_refused(options, [&](auto *f) {
      lsdcd_grid *made = nullptr;
      return lsdcd_grid_build(mesh.get(), f, &made);
    });
  }
  EXPECT_EQ(distance, 7);
}

TEST(library, edges_of_the_welded_mesh_join_corners_of_their_faces)
{
  const lsdcd::MeshArrays m = lsdcd::Mesh(numbers(box_and_cylinder())).arrays();
  ASSERT_EQ(m.edge_first.front(), 0u);
  ASSERT_EQ(m.edge_first.back(), m.edge_faces.size());
  std::vector<int> met(m.faces.size());
  for (std::size_t e = 0; e + 1 < m.edge_first.size(); e++)
    for (std::uint32_t i = m.edge_first[e]; i < m.edge_first[e + 1]; i++)
      for (int k = 0; k < 3; k++) {
        const std::uint32_t *face = &m.faces[3 * m.edge_faces[i]];
        if (m.face_edges[3 * m.edge_faces[i] + k] != e) continue;
        met[3 * m.edge_faces[i] + k]++;
        const auto [low, high] = std::minmax(face[k], face[(k + 1) % 3]);
        EXPECT_EQ(m.edges[2 * e], low) << e;
        EXPECT_EQ(m.edges[2 * e + 1], high) << e;
      }
  EXPECT_EQ(met, std::vector<int>(met.size(), 1));
}

TEST(library, features_of_answers_are_those_of_the_welded_mesh)
{
  const lsdcd::Mesh mesh(numbers(box_and_cylinder()));
  const lsdcd::MeshArrays m = mesh.arrays();
  const std::vector<double> points = random_points<double>(4000);
  const All<double> a(lsdcd::Grid(mesh), points);
  std::array<int, 3> seen = {};
  for (std::size_t i = 0; i < a.feature.size(); i++) {
    const std::uint32_t kind = LSDCD_FEATURE_KIND(a.feature[i]),
                        f = LSDCD_FEATURE_INDEX(a.feature[i]);
    const Vec3 c = point(a.closest, i);
    seen[kind]++;
    // In coordinates of at most 1.5 the closest point is rounded by less than 1e-14.
    if (kind == 2) {
      EXPECT_LT(norm(point(m.vertices, f) - c), 1e-14) << i;
    } else if (kind == 1) {
      const Vec3 p = point(m.vertices, m.edges[2 * f]), q = point(m.vertices, m.edges[2 * f + 1]);
      EXPECT_LT(norm(p - c) + norm(q - c) - norm(p - q), 1e-14) << i;
    } else {
      EXPECT_EQ(m.triangle[f], a.triangle[i]) << i;
    }
  }
  for (const int n : seen) EXPECT_GT(n, 50);
}

TEST(library, a_grid_outlives_its_mesh)
{
  auto mesh = std::make_unique<lsdcd::Mesh>(numbers(box_and_cylinder()));
  const lsdcd::Grid grid(*mesh, kCutoff);
  mesh.reset();
  EXPECT_EQ(grid.distances(std::vector<double>{1.25, 0, 0})[0], 0.25);
}

TEST(library, eight_threads_at_once_get_what_one_gets)
{
  const lsdcd::Mesh mesh(numbers(box_and_cylinder()));
  const lsdcd::Grid shared(mesh, kCutoff);
  const std::vector<double> points = random_points<double>(20000);
  const All<double> alone(shared, points);
  std::vector<int> different(8, 0);
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; t++)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 5; k++) {
        const All<double> a(shared, points);
        different[t] += a.distance != alone.distance || a.feature != alone.feature;
        const lsdcd::Grid own(mesh, kCutoff + 0.01 * t);
        different[t] += own.distances(points, kCutoff) != alone.distance;
        // A refusal is told to the thread that it is for.
        try {
          shared.distances(points, 1 + t);
          different[t]++;
        } catch (const lsdcd::Error &e) {
          const std::string number = "is " + std::to_string(1 + t) + ",";
          different[t] += std::string(e.what()).find(number) == std::string::npos;
        }
      }
    });
  for (std::thread &t : threads) t.join();
  for (int d : different) EXPECT_EQ(d, 0);
}

TEST(library, threads_of_a_query_do_not_change_it)
{
  const lsdcd::Grid grid = grid_of(box_and_cylinder());
  const std::vector<double> points = random_points<double>(20000);
  std::vector<double> out(points.size() / 3);
  lsdcd::Query<double> q(points.data(), out.size());
  q.threads = 3;
  q.distance = out.data();
  grid.query(q);
  EXPECT_EQ(out, grid.distances(points));
}

TEST(library, a_cache_is_read_the_second_time)
{
  lsdcd::TempDir folder;
  const std::string file = folder.path("grid.cache");
  const lsdcd::Mesh mesh(numbers(box_and_cylinder()));
  const auto grid = [&] {
    lsdcd::GridOptions options(kCutoff);
    options.cache = file.c_str();
    return lsdcd::Grid(mesh, options);
  };
  const lsdcd::Grid built = grid(), read = grid();
  EXPECT_FALSE(built.facts().from_cache);
  EXPECT_TRUE(read.facts().from_cache);
  const std::vector<double> points = random_points<double>(1000);
  EXPECT_EQ(built.distances(points), read.distances(points));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_FALSE(grid().facts().from_cache);    // damaged
  EXPECT_TRUE(grid().facts().from_cache);     // and replaced

  folder.write("grid.cache", "something else");
  const lsdcd::Grid beside = grid();
  EXPECT_TRUE(lsdcd::has(beside.report(), "it stays as it is"));
}

// Numbers have points in every locale: the reports begin with these. That of the caller stays.
TEST(library, reports_have_points_in_numbers_whatever_the_locale)
{
  const lsdcd::CommaLocale commas;
  if (!commas.works()) GTEST_SKIP() << "this C library takes no locale of ours";
  const lsdcd::Mesh mesh(numbers(lsdcd::box_mesh({0, 0, 0}, {0.5, 1, 1})));
  EXPECT_TRUE(lsdcd::has(mesh.report(), "(0.5, 1, 1)"));
  const std::string grid = lsdcd::Grid(mesh, 0.25).report();
  EXPECT_TRUE(lsdcd::has(grid, "cutoff 0.25"));
  char half[8];
  std::snprintf(half, sizeof half, "%g", 0.5);
  EXPECT_STREQ(half, "0,5");
}

// ---- the CUDA driver ----------------------------------------------------------------------

TEST(library, a_query_looks_for_the_driver_only_after_something_was_loaded)
{
  const lsdcd::Grid grid = grid_of(box_and_cylinder());
  const std::vector<double> points = {1.25, 0, 0};
  grid.distances(points);
  const int before = n_dlopens;
  for (int k = 0; k < 100; k++) grid.distances(points);
  EXPECT_EQ(n_dlopens, before);
}

// In a process of its own, which keeps that driver.
TEST(library, a_driver_that_is_loaded_after_the_first_query_is_noticed)
{
  if (dlopen("libcuda.so.1", RTLD_NOLOAD | RTLD_LAZY)) GTEST_SKIP() << "a driver is loaded";
  const lsdcd::Grid grid = grid_of(box_and_cylinder());
  const std::vector<double> points = {1.25, 0, 0};
  const auto load_between_two = [&] {
    grid.distances(points);
    if (!dlopen(LSDCD_FAKE_CUDA, RTLD_NOW)) std::_Exit(-1);
    double distance;
    lsdcd_query q = lsdcd::Query<double>(points.data(), 1);
    q.distance = &distance;
    std::_Exit(lsdcd_query_host(grid.get(), &q));
  };
  EXPECT_EXIT(load_between_two(), ::testing::ExitedWithCode(LSDCD_ERROR_DEVICE), "");
}

// ---- wrong use ----------------------------------------------------------------------------

class Wrong : public ::testing::Test {
 protected:
  const lsdcd::Mesh mesh{numbers(box_and_cylinder())};
  const lsdcd::Grid grid{mesh, kCutoff};
  const double at[6] = {0, 0, 0, 1.1, 0, 0};
  double distance[2] = {-1, -1};
  lsdcd_query q = lsdcd::Query<double>(at, 2);
  void SetUp() override { q.distance = distance; }

  // The code that it gives, and a text with `says`.
  static void expect(int code, int wanted, const char *says)
  {
    EXPECT_EQ(lsdcd_error_name(code), std::string(lsdcd_error_name(wanted)));
    EXPECT_TRUE(lsdcd::has(lsdcd_last_error(), says));
  }
  void refused(int wanted, const char *says)
  {
    expect(lsdcd_query_host(grid.get(), &q), wanted, says);
    EXPECT_EQ(distance[0], -1);
  }
};

// ---- contacts ----------------------------------------------------------------------------

template <class T>
std::vector<T> some_radii(std::size_t n)
{
  std::mt19937 r(5);
  std::uniform_real_distribution<double> of(0.02, kCutoff - 0.01);
  std::vector<T> radii(n);
  for (T &x : radii) x = static_cast<T>(of(r));
  return radii;
}

// That they are all local minima is a property of the search: test_properties, test_oracle_cgal. `tolerance`: the rounding of
// answers in T, of coordinates up to 1.5, and the mesh's, 1e-9 of 1.
template <class T>
void expect_places(double tolerance)
{
  const TriangleSoup soup = box_and_cylinder();
  const std::vector<T> points = random_points<T>(300), radii = some_radii<T>(300);
  const lsdcd::Contacts<T> a = grid_of(soup).contacts(points, radii);
  std::size_t with_several = 0;
  for (std::size_t i = 0; i < radii.size(); i++) {
    const Vec3 q = point(points, i);
    double least = HUGE_VAL;
    for (std::size_t k = a.first[i]; k < a.first[i + 1]; k++) {
      const Vec3 p = point(a.point, k), n = point(a.normal, k);
      const double d = static_cast<double>(a.distance[k]);
      least = std::min(least, d);
      EXPECT_NEAR(d, norm(q - p), tolerance) << i;
      EXPECT_NEAR(static_cast<double>(a.overlap[k]), static_cast<double>(radii[i]) - d, tolerance)
          << i;
      EXPECT_LT(norm(d * n - (q - p)), tolerance) << i;
      EXPECT_LT(distance_to(soup, a.triangle[k], p), tolerance) << i;
    }
    const double truth = brute(soup, q);
    if (std::isfinite(least))
      EXPECT_NEAR(least, truth, tolerance) << i;
    else
      EXPECT_GT(truth, static_cast<double>(radii[i]) - tolerance) << i;
    with_several += a.first[i + 1] - a.first[i] > 1;
  }
  EXPECT_GT(with_several, radii.size() / 40);
}

TEST(contacts, are_on_the_mesh_and_the_nearest_is_among_them)
{
  expect_places<double>(2e-9);
  expect_places<float>(1e-6);
}

// Two walls whose normals have the cosine c = 0.5, with the overlaps d = 0.05 and 0.04: l = weight d is what makes l + c l' = d of
// either wall, so that l = (d - c d')/(1 - c^2). The rule has c less up to 1e-6, which changes a weight by less than 2e-6.
TEST(contacts, have_weights_that_share_the_overlap)
{
  constexpr double kRadius = 0.3, kOnFlat = 0.05, kOnSlope = 0.04, kCosine = 0.5;
  const lsdcd::Grid grid(lsdcd::Mesh(numbers(lsdcd::hinge_mesh(60, 2))), kCutoff);
  // The slope is at the distance z cos 60 - x sin 60.
  const double z = kRadius - kOnFlat, sine = std::sqrt(1 - kCosine * kCosine),
               x = (kCosine * z - (kRadius - kOnSlope)) / sine;
  const lsdcd::Contacts<double> a =
      grid.contacts(std::vector<double>{x, 0.1, z}, std::vector<double>{kRadius});
  ASSERT_EQ(a.weight.size(), 2u);
  ASSERT_GT(std::abs(a.normal[2] - a.normal[5]), 0.4);
  for (int k = 0; k < 2; k++) {
    const bool flat = a.normal[3 * k + 2] > 0.75;
    const double own = flat ? kOnFlat : kOnSlope, other = flat ? kOnSlope : kOnFlat;
    EXPECT_NEAR(a.overlap[k], own, 1e-15);
    EXPECT_NEAR(a.weight[k], (1 - kCosine * other / own) / (1 - kCosine * kCosine), 2e-6) << k;
  }
}

TEST(contacts, of_more_than_few_places_are_all_there)
{
  // A sphere above 100 pillars' tips.
  std::vector<double> at;
  std::vector<std::uint32_t> faces;
  for (int i = 0; i < 10; i++)
    for (int k = 0; k < 10; k++)
      for (int v = 0; v < 3; v++) {
        const double angle = 2 * std::acos(-1.0) / 3 * v, wide = v < 2 ? 0.002 : 0;
        at.insert(at.end(), {0.02 * i + wide * std::cos(angle), 0.02 * k + wide * std::sin(angle),
                             v < 2 ? -1.0 : 0.0});
        faces.push_back(static_cast<std::uint32_t>(faces.size()));
      }
  const lsdcd::Grid grid(lsdcd::Mesh(at, faces), 0.3);
  const lsdcd::Contacts<double> a =
      grid.contacts(std::vector<double>{0.09, 0.09, 0.1}, std::vector<double>{0.3});
  EXPECT_EQ(a.first[1], 100u);
}

TEST(contacts, are_the_same_with_threads_and_in_one_call_or_many)
{
  const lsdcd::Grid grid = grid_of(box_and_cylinder());
  const std::vector<double> points = random_points<double>(3000), radii = some_radii<double>(3000);
  const lsdcd::Contacts<double> a = grid.contacts(points, radii, 1),
                                b = grid.contacts(points, radii, 4);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.feature, b.feature);
  EXPECT_EQ(a.weight, b.weight);
  for (std::size_t i = 0; i < 100; i++) {
    const lsdcd::Contacts<double> one = grid.contacts(
        std::vector<double>(&points[3 * i], &points[3 * i] + 3), std::vector<double>{radii[i]});
    EXPECT_EQ(one.point, std::vector<double>(a.point.begin() + 3 * std::ptrdiff_t(a.first[i]),
                                             a.point.begin() + 3 * std::ptrdiff_t(a.first[i + 1])));
  }
}

TEST_F(Wrong, contacts_of_what_has_none)
{
  const double points[] = {0, 0, 0, 0, 0, 0}, radii[] = {0.1, 7};
  std::size_t first[3];
  lsdcd_contacts c = {};
  c.size = sizeof c;
  c.n = 2;
  c.points = points;
  c.first = first;
  const auto refused = [&](const lsdcd::Grid &by, int code, const char *says) {
    expect(lsdcd_contacts_host(by.get(), &c), code, says);
  };
  const TriangleSoup soup = box_and_cylinder();
  refused(lsdcd::Grid(lsdcd::Mesh(numbers(soup))), LSDCD_ERROR_CUTOFF, "has none");
  refused(grid_of(soup, 4), LSDCD_ERROR_ARGUMENT, "`nearest`");
  refused(grid_of(soup, 0, LSDCD_FLOAT), LSDCD_ERROR_ARGUMENT, "`precision`");
  const lsdcd::Grid good = grid_of(soup);
  c.radius = 7;
  refused(good, LSDCD_ERROR_CUTOFF, "`radius` is 7");
  c.radius = -1;
  refused(good, LSDCD_ERROR_ARGUMENT, "`radius` is -1");
  c.radius = 0;
  c.radii = radii;
  refused(good, LSDCD_ERROR_CUTOFF, "sphere 1 has radius 7");
  c.type = 2;
  refused(good, LSDCD_ERROR_ARGUMENT, "`type`");
  c.type = LSDCD_DOUBLE;
  c.first = nullptr;
  refused(good, LSDCD_ERROR_ARGUMENT, "`first` is null");
}

TEST_F(Wrong, null_pointers)
{
  lsdcd_mesh *m = nullptr;
  lsdcd_grid *g = nullptr;
  lsdcd_stream *s = nullptr;
  lsdcd::GridOptions o(1);
  expect(lsdcd_mesh_read(nullptr, -1, &m), LSDCD_ERROR_ARGUMENT, "`file` is null");
  expect(lsdcd_mesh_read("x.stl", -1, nullptr), LSDCD_ERROR_ARGUMENT, "`mesh` is null");
  expect(lsdcd_mesh_from_corners(nullptr, 1, -1, &m), LSDCD_ERROR_ARGUMENT, "`corners` is null");
  expect(lsdcd_mesh_get_facts(nullptr, nullptr), LSDCD_ERROR_ARGUMENT, "`mesh` is null");
  expect(lsdcd_grid_build(nullptr, &o, &g), LSDCD_ERROR_ARGUMENT, "`mesh` is null");
  expect(lsdcd_grid_build(mesh.get(), nullptr, &g), LSDCD_ERROR_ARGUMENT, "is null");
  expect(lsdcd_grid_build(mesh.get(), &o, nullptr), LSDCD_ERROR_ARGUMENT, "`grid` is null");
  expect(lsdcd_query_host(nullptr, &q), LSDCD_ERROR_ARGUMENT, "`grid` is null");
  expect(lsdcd_query_host(grid.get(), nullptr), LSDCD_ERROR_ARGUMENT, "is null");
  expect(lsdcd_query_stream(nullptr, &q), LSDCD_ERROR_ARGUMENT, "`stream` is null");
  expect(lsdcd_stream_open(grid.get(), nullptr, nullptr), LSDCD_ERROR_ARGUMENT, "`stream` is null");
  expect(lsdcd_stream_open(nullptr, nullptr, &s), LSDCD_ERROR_ARGUMENT, "`grid` is null");
  EXPECT_TRUE(!m && !g && !s);
  q.points = nullptr;
  refused(LSDCD_ERROR_ARGUMENT, "`points` is null");
  EXPECT_STREQ(lsdcd_mesh_report(nullptr), "");
  EXPECT_STREQ(lsdcd_grid_report(nullptr), "");
  lsdcd_mesh_free(nullptr);
  lsdcd_grid_free(nullptr);
  lsdcd_stream_free(nullptr);
}

TEST_F(Wrong, no_points_are_no_error)
{
  q.n = 0;
  q.points = nullptr;
  EXPECT_EQ(lsdcd_query_host(grid.get(), &q), LSDCD_OK);
}

TEST_F(Wrong, an_empty_batch_is_no_error_in_cpp)
{
  EXPECT_TRUE(grid.distances(std::vector<double>()).empty());
}

TEST_F(Wrong, points_and_corners_with_numbers_left_over)
{
  const auto code_of = [](const auto &call) {
    try {
      call();
    } catch (const lsdcd::Error &e) {
      return e.code();
    }
    return LSDCD_OK + 0;
  };
  EXPECT_EQ(code_of([&] { grid.distances(std::vector<double>(4)); }), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(code_of([&] { lsdcd::Mesh(std::vector<double>(10)); }), LSDCD_ERROR_ARGUMENT);
}

TEST_F(Wrong, numbers_of_a_query)
{
  const double beyond[] = {0.1, std::nextafter(kCutoff, 1)}, below[] = {0, -0.1}, none[] = {0, NAN};
  const struct {
    std::function<void(lsdcd_query &)> spoil;
    const char *says;
    int code = LSDCD_ERROR_ARGUMENT;
  } rows[] = {
      {[&](auto &w) { w.radius = beyond[1]; }, "more than the grid's cutoff", LSDCD_ERROR_CUTOFF},
      {[&](auto &w) { w.radii = beyond; }, "point 1 has radius 0.4", LSDCD_ERROR_CUTOFF},
      {[&](auto &w) { w.radii = below; }, "point 1 has radius"},
      {[&](auto &w) { w.radii = none; }, "point 1 has radius"},
      {[](auto &w) { w.radius = -2e-9; }, "`radius` is -2e-09"},
      {[](auto &w) { w.radius = NAN; }, "`radius` is"},
      {[&](auto &w) { w.radius = 0.1, w.radii = at; }, "both given"},
      {[](auto &w) { w.type = 7; }, "`type`"},
      {[](auto &w) { w.distance = nullptr; }, "nothing is asked for"},
      {[](auto &w) { w.estimate_sides = 2; }, "`estimate_sides` is 2: it is 0 or 1"},
      {[](auto &w) { w.threads = 50000; }, "`threads` is 50000"},
  };
  const lsdcd_query right = q;
  for (const auto &row : rows) {
    q = right;
    row.spoil(q);
    expect(lsdcd_query_host(grid.get(), &q), row.code, row.says);
  }
}

TEST_F(Wrong, the_side_of_an_open_mesh)
{
  const lsdcd::Grid open(lsdcd::Mesh(numbers(lsdcd::floor_mesh(2, 1))), kCutoff);
  std::int8_t side[2];
  q.side = side;
  expect(lsdcd_query_host(open.get(), &q), LSDCD_ERROR_SIDE, "not closed");
}

TEST_F(Wrong, a_file_that_is_not_there)
{
  lsdcd_mesh *m = nullptr;
  expect(lsdcd_mesh_read("/nowhere/wall.stl", -1, &m), LSDCD_ERROR_INPUT, "/nowhere/wall.stl");
}

TEST_F(Wrong, corners_that_are_not_finite)
{
  std::vector<double> corners = numbers(box_and_cylinder());
  corners[9 * 4 + 2] = NAN;
  lsdcd_mesh *m = nullptr;
  expect(lsdcd_mesh_from_corners(corners.data(), 6, -1, &m), LSDCD_ERROR_INPUT, "triangle 4");
  expect(lsdcd_mesh_from_corners(corners.data(), 0, -1, &m), LSDCD_ERROR_ARGUMENT, "is 0");
  expect(lsdcd_mesh_from_corners(corners.data(), 2, NAN, &m), LSDCD_ERROR_ARGUMENT, "`weld`");
}

TEST_F(Wrong, faces_whose_vertices_are_not_there_or_not_finite)
{
  std::vector<float> at = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, NAN, 0};
  const std::uint32_t past[] = {0, 1, 2, 0, 2, 4}, not_finite[] = {0, 1, 2, 0, 2, 3};
  lsdcd_mesh *m = nullptr;
  const auto made_of = [&](const std::uint32_t *faces, std::size_t n, int type = LSDCD_FLOAT) {
    return lsdcd_mesh_from_faces(at.data(), type, 4, faces, n, -1, &m);
  };
  expect(made_of(past, 2), LSDCD_ERROR_INPUT, "face 1 (from 0) has the vertex 4; there are 4");
  expect(made_of(not_finite, 2), LSDCD_ERROR_INPUT,
         "face 1 (from 0) has the vertex 3, whose y is nan");
  expect(made_of(past, 0), LSDCD_ERROR_ARGUMENT, "`n_faces` is 0");
  expect(made_of(past, 1, 2), LSDCD_ERROR_ARGUMENT, "`type`");
  expect(made_of(nullptr, 1), LSDCD_ERROR_ARGUMENT, "`faces` is null");
  expect(lsdcd_mesh_from_faces(at.data(), LSDCD_FLOAT, SIZE_MAX, past, 1, -1, &m),
         LSDCD_ERROR_ARGUMENT, "`n_vertices` is 18446744073709551615; faces number at most");
  EXPECT_EQ(m, nullptr);
  // The vertex that is no number belongs to no face.
  EXPECT_EQ(made_of(past, 1), LSDCD_OK);
  lsdcd_mesh_free(m);
}

TEST_F(Wrong, options_that_make_no_grid)
{
  const struct {
    std::function<void(lsdcd::GridOptions &)> spoil;
    const char *says;
    int code = LSDCD_ERROR_ARGUMENT;
  } rows[] = {
      {[](auto &o) { o.cutoff = -1; }, "cutoff"},
      {[](auto &o) { o.cutoff = HUGE_VAL; }, "cutoff"},
      {[](auto &o) { o.cutoff = 1e101; }, "cutoff"},
      {[](auto &o) { o.cell = -1; }, "cell"},
      {[](auto &o) { o.nearest = 33; }, "nearest"},
      {[](auto &o) { o.precision = 2; }, "precision"},
      {[](auto &o) { o.memory = -1; }, "memory"},
      {[](auto &o) { o.threads = -1; }, "threads"},
      {[](auto &o) { o.threads = 50000; }, "`threads` is 50000; it is 0 to 4096"},
      {[](auto &o) { o.device = 2; }, "device"},
      // Without a cutoff there are no cells.
      {[](auto &o) { o.cutoff = 0, o.cell = 0.1; }, "need a cutoff"},
      {[](auto &o) { o.cutoff = 0, o.nearest = 2; }, "need a cutoff"},
      {[](auto &o) { o.cutoff = 0, o.precision = LSDCD_FLOAT; }, "need a cutoff"},
      {[](auto &o) { o.cutoff = 0, o.memory = 1e9; }, "need a cutoff"},
      {[](auto &o) { o.cutoff = 0, o.cache = "grid.cache"; }, "need a cutoff"},
      // Too much memory, or time.
      {[](auto &o) { o.cell = 8e-3, o.memory = 1e6; }, "`cell` 0.008", LSDCD_ERROR_INPUT},
      {[](auto &o) { o.cell = 8e-3, o.memory = 1e6; }, "or leave `cell` out", LSDCD_ERROR_INPUT},
      {[](auto &o) { o.memory = 1e3; }, "MB: give that", LSDCD_ERROR_INPUT},
      {[](auto &o) { o.cell = 8e-3; }, "`cell` 0.008 is too fine", LSDCD_ERROR_INPUT},
  };
  for (const auto &row : rows) {
    lsdcd::GridOptions options(kCutoff);
    row.spoil(options);
    lsdcd_grid *g = nullptr;
    expect(lsdcd_grid_build(mesh.get(), &options, &g), row.code, row.says);
  }
}

#if !defined(LSDCD_HAVE_CUDA)
TEST_F(Wrong, a_stream_without_cuda)
{
  int not_one = 0;
  expect(lsdcd_query_stream(reinterpret_cast<lsdcd_stream *>(&not_one), &q), LSDCD_ERROR_DEVICE,
         "CPU only");
}
#endif

TEST_F(Wrong, a_gpu_that_is_not_there)
{
  if (lsdcd_has_cuda()) GTEST_SKIP() << "there is a GPU";
  lsdcd_stream *s = nullptr;
  EXPECT_NE(lsdcd_stream_open(grid.get(), nullptr, &s), LSDCD_OK);
  EXPECT_STRNE(lsdcd_last_error(), "");
  lsdcd::GridOptions o(kCutoff);
  o.device = LSDCD_CUDA;
  lsdcd_grid *g = nullptr;
  expect(lsdcd_grid_build(mesh.get(), &o, &g), LSDCD_ERROR_DEVICE, "CUDA");
}

}    // namespace
}    // namespace test_library
