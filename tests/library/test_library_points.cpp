// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Barycentric coordinates and signed distances of the library, in quad precision and closed forms.
#include "base/quad.h"
#include "points_and_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace test_library_points {
namespace {

using lsdcd::Quad;
using lsdcd::TriangleSoup;
using lsdcd::Vec3;

constexpr double kUnit = 2.220446049250313e-16;    // twice the rounding of numbers of order 1

struct QuadVec {
  Quad x, y, z;
};
QuadVec quad(const Vec3 &a)
{
  return {a.x, a.y, a.z};
}
QuadVec operator-(const QuadVec &a, const QuadVec &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Quad dot(const QuadVec &a, const QuadVec &b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
double length(const QuadVec &a)
{
  return std::sqrt(static_cast<double>(dot(a, a)));
}

// The point of a triangle with these shares of its corners.
template <class T>
QuadVec point_of(const Vec3 *corner, const T *share)
{
  QuadVec p = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    p.x += Quad(share[k]) * corner[k].x;
    p.y += Quad(share[k]) * corner[k].y;
    p.z += Quad(share[k]) * corner[k].z;
  }
  return p;
}

// Shares of b and c in the foot of q in the plane of the triangle: the normal equations, which in quad lose nothing that
// a double has, also of a triangle of 1e11 : 1.
std::array<Quad, 3> shares_of_foot(const Vec3 *corner, const Vec3 &q)
{
  const QuadVec u = quad(corner[1]) - quad(corner[0]), v = quad(corner[2]) - quad(corner[0]),
                w = quad(q) - quad(corner[0]);
  const Quad uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v),
             area = uu * vv - uv * uv;
  const Quad b = (vv * wu - uv * wv) / area, c = (uu * wv - uv * wu) / area;
  return {1 - b - c, b, c};
}

double height_of(const Vec3 *corner)
{
  const QuadVec u = quad(corner[1]) - quad(corner[0]), v = quad(corner[2]) - quad(corner[0]);
  const Quad area_sq = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
  double longest = 0;
  for (int k = 0; k < 3; k++)
    longest = std::max(longest, length(quad(corner[(k + 1) % 3]) - quad(corner[k])));
  return std::sqrt(static_cast<double>(area_sq)) / longest;
}

Vec3 random_unit(std::mt19937 &r)
{
  std::normal_distribution<double> at;
  const Vec3 v = {at(r), at(r), at(r)};
  return (1 / norm(v)) * v;
}

// Triangles at random places, sharp, blunt and thin, down to a height of 1e-11 of their length.
TriangleSoup random_triangles(std::size_t n)
{
  std::mt19937 r(7);
  std::uniform_real_distribution<double> place(-1, 1), foot(-0.5, 1.5), digits(-11, 0);
  TriangleSoup soup;
  for (std::size_t t = 0; t < n; t++) {
    const Vec3 a = {place(r), place(r), place(r)}, e = random_unit(r), x = random_unit(r),
               across = x - dot(x, e) * e;
    Vec3 corner[] = {a, a + 0.5 * e,
                     a + 0.5 * foot(r) * e + 0.5 * std::pow(10, digits(r)) / norm(across) * across};
    std::rotate(corner, corner + t % 3, corner + 3);
    soup.corners.insert(soup.corners.end(), corner, corner + 3);
  }
  return soup;
}

// Points whose feet lie in and around these triangles.
template <class T>
std::vector<T> points_near(const TriangleSoup &soup, std::size_t n)
{
  std::mt19937 r(8);
  std::uniform_real_distribution<double> share(-0.2, 1), up(-0.1, 0.1);
  std::vector<T> points;
  for (std::size_t i = 0; i < n; i++) {
    const Vec3 *c = &soup.corners[3 * (i % soup.n_triangles())];
    const double b = share(r), of_c = share(r);
    const Vec3 n_up = cross(c[1] - c[0], c[2] - c[0]),
               q = c[0] + b * (c[1] - c[0]) + of_c * (c[2] - c[0]) + up(r) / norm(n_up) * n_up;
    points.insert(points.end(), {T(q.x), T(q.y), T(q.z)});
  }
  return points;
}

template <class T>
struct Shares {
  std::vector<T> closest, barycentric;
  std::vector<std::uint32_t> triangle, feature;

  Shares(const lsdcd::Grid &grid, const std::vector<T> &points) :
      closest(points.size()), barycentric(points.size()), triangle(points.size() / 3),
      feature(triangle.size())
  {
    lsdcd::Query<T> q(points.data(), triangle.size());
    q.closest = closest.data();
    q.barycentric = barycentric.data();
    q.triangle = triangle.data();
    q.feature = feature.data();
    grid.query(q);
  }
};

// How far the point of each answer's shares is from its closest point, at most. Shares are from 0 to 1, and their sum
// is 1 up to a rounding of each.
template <class T>
double farthest(const TriangleSoup &soup, const Shares<T> &s, double rounding)
{
  double most = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < s.triangle.size(); i++) {
    if (s.triangle[i] == LSDCD_NONE) continue;
    found++;
    const T *share = &s.barycentric[3 * i];
    for (int k = 0; k < 3; k++) EXPECT_TRUE(share[k] >= 0 && share[k] <= 1) << i;
    EXPECT_LE(std::fabs(double(Quad(share[0]) + share[1] + share[2] - 1)), 3 * rounding) << i;
    const QuadVec p = point_of(&soup.corners[3 * std::size_t(s.triangle[i])], share);
    most = std::max(most, length(p - quad(point(s.closest, i))));
  }
  EXPECT_GT(found, s.triangle.size() / 2);
  return most;
}

// Coordinates are below 2, so that each is rounded by a unit at most: the closest point's, their differences and, times
// them, the shares. These are some eight roundings, also in triangles of 1e11 : 1.
constexpr double kOfSums = 8 * kUnit;

TEST(barycentric, times_the_corners_is_the_closest_point_and_on_a_face_the_foot_of_the_point)
{
  const TriangleSoup soup = random_triangles(400);
  const std::vector<double> points = points_near<double>(soup, 20000);
  const Shares<double> s(lsdcd::Grid(lsdcd::Mesh(numbers(soup), 0)), points);
  EXPECT_LE(farthest(soup, s, kUnit / 2), kOfSums);
  int faces = 0, thin = 0;
  for (std::size_t i = 0; i < s.triangle.size(); i++) {
    if (LSDCD_FEATURE_KIND(s.feature[i]) != 0) continue;
    const Vec3 *corner = &soup.corners[3 * std::size_t(s.triangle[i])];
    const std::array<Quad, 3> wanted = shares_of_foot(corner, point(points, i));
    const double height = height_of(corner);
    faces++;
    thin += height < 1e-7;
    // A foot that is off by so much has shares that are off by so much over the height.
    for (int k = 0; k < 3; k++)
      ASSERT_LE(std::fabs(double(wanted[k] - s.barycentric[3 * i + k])), kOfSums / height) << i;
  }
  EXPECT_GT(faces, 1000);
  EXPECT_GT(thin, 100);
}

// Cells in double find places to 1e-8 here, in float to 3e-6 (0.4 + 14 cells), as test_library has it; floats of
// coordinates below 2 are rounded by 1.2e-7, three of them and three shares.
template <class T>
void expect_shares_by_cells()
{
  const TriangleSoup soup = box_and_cylinder();
  const std::vector<T> points = points_near<T>(soup, 5000);
  for (const bool in_float : {false, true}) {
    lsdcd::GridOptions options(0.4);
    options.nearest = in_float ? 0 : 4;
    options.precision = in_float ? LSDCD_FLOAT : LSDCD_DOUBLE;
    options.cell = 0.1;
    const Shares<T> s(lsdcd::Grid(lsdcd::Mesh(numbers(soup)), options), points);
    const double rounding = sizeof(T) == sizeof(float) ? 6e-8 : kUnit / 2;
    EXPECT_LE(farthest(soup, s, rounding), (in_float ? 3e-6 * (0.4 + 1.4) : 1e-8) + 12 * rounding);
  }
}
TEST(barycentric, of_cells_is_right_to_their_precision)
{
  expect_shares_by_cells<double>();
  expect_shares_by_cells<float>();
}

// ---- signed distances ---------------------------------------------------------------------------

const TriangleSoup kBox = lsdcd::box_mesh({-1, -1, -1}, {1, 1, 1});

double signed_distance_to_box(const Vec3 &q)
{
  const Vec3 past = {std::fabs(q.x) - 1, std::fabs(q.y) - 1, std::fabs(q.z) - 1};
  const double largest = std::max({past.x, past.y, past.z});
  if (largest <= 0) return largest;
  return std::hypot(std::max(past.x, 0.), std::max(past.y, 0.), std::max(past.z, 0.));
}

// Beyond the cutoff it is infinite, with the sign of the side.
template <class T>
void expect_box(const lsdcd::GridOptions &options, double tolerance)
{
  const lsdcd::Grid grid(lsdcd::Mesh(numbers(kBox)), options);
  const std::vector<T> points = random_points<T>(5000, 2);
  const std::vector<T> found = grid.signed_distances(points);
  const double cutoff = options.cutoff > 0 ? options.cutoff : HUGE_VAL;
  for (std::size_t i = 0; i < found.size(); i++) {
    const double wanted = signed_distance_to_box(point(points, i));
    if (std::fabs(std::fabs(wanted) - cutoff) <= tolerance) continue;
    if (std::fabs(wanted) > cutoff)
      ASSERT_EQ(found[i], std::copysign(HUGE_VAL, wanted)) << i;
    else
      ASSERT_NEAR(found[i], wanted, tolerance) << i;
  }
}

TEST(signed_distance, is_that_of_a_box_negative_inside)
{
  lsdcd::GridOptions nearest(0.4), in_float(0.4);
  nearest.nearest = 12;    // all of the box: certain
  in_float.precision = LSDCD_FLOAT;
  // Numbers below 4: some eight roundings, in floats of 1.2e-7; cells as above, with those that are chosen.
  expect_box<double>(lsdcd::GridOptions(), 32 * kUnit);
  expect_box<double>(lsdcd::GridOptions(0.4), 32 * kUnit);
  expect_box<double>(nearest, 1e-8);
  expect_box<double>(in_float, 4e-6);
  expect_box<float>(lsdcd::GridOptions(), 1e-6);
  expect_box<float>(lsdcd::GridOptions(0.4), 1e-6);
}

// The feature that is nearest in float may be of the other face of the plate. No point is inside.
TEST(signed_distance, in_float_has_the_side_of_a_plate_that_is_thinner_than_its_error)
{
  lsdcd::GridOptions options(10);
  options.precision = LSDCD_FLOAT;
  const lsdcd::Grid grid(lsdcd::Mesh(numbers(lsdcd::box_mesh({0, 0, 0}, {1, 2, 1e-7}))), options);
  for (const double x : grid.signed_distances(random_points<double>(20000, 6))) ASSERT_GT(x, 0);
}

TEST(signed_distance, is_0_without_a_sign_on_the_mesh_and_none_of_what_is_no_number)
{
  for (const double cutoff : {0., 0.4}) {
    const lsdcd::Grid grid(lsdcd::Mesh(numbers(kBox)), cutoff);
    for (const double d : grid.signed_distances<double>({1, 0, 0, 1, 1, 0.5, -1, -1, -1})) {
      EXPECT_EQ(d, 0);
      EXPECT_FALSE(std::signbit(d));
    }
    EXPECT_TRUE(std::isnan(grid.signed_distances<double>({NAN, 0, 0})[0])) << cutoff;
  }
}

TEST(signed_distance, of_an_open_mesh_is_refused_or_estimated)
{
  TriangleSoup soup = kBox;
  soup.corners.resize(soup.corners.size() - 3);
  const lsdcd::Grid grid(lsdcd::Mesh(numbers(soup)), 0.4);
  const std::vector<double> points = {0, 0, 0, 0.9, 0, 0, 1.1, 0, 0, 0, 0, 5};
  try {
    grid.signed_distances(points);
    FAIL();
  } catch (const lsdcd::Error &e) {
    EXPECT_EQ(e.code(), LSDCD_ERROR_SIDE);
    EXPECT_TRUE(lsdcd::has(e.what(), "estimate_sides"));
  }
  const std::vector<double> found = grid.signed_distances(points, 0, true);
  EXPECT_EQ(found[0], -HUGE_VAL);
  EXPECT_NEAR(found[1], -0.1, kUnit);
  EXPECT_NEAR(found[2], 0.1, kUnit);
  EXPECT_EQ(found[3], HUGE_VAL);

  std::vector<double> out(4);
  std::vector<std::uint8_t> status(4);
  lsdcd::Query<double> q(points.data(), 4);
  q.signed_distance = out.data();
  q.status = status.data();
  q.estimate_sides = true;
  grid.query(q);
  for (const std::uint8_t s : status) EXPECT_TRUE(s & LSDCD_SIDE_ESTIMATED);
}

}    // namespace
}    // namespace test_library_points
