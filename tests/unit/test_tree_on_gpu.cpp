// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tree's query on a GPU against the same on the CPU: one source, so the same bits.
#include "support/device_memory.h"
#include "support/tree_case.h"

#include "mesh/meets_itself.h"
#include "query/point_sides.h"
#include "query/tree_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace lsdcd {
namespace {

// Some more are so far that squares of their coordinates overflow, in float infinitely far, or no numbers.
template <class T>
std::vector<T> coordinates(const TreeCase &c, std::size_t n)
{
  std::vector<T> out;
  for (const std::vector<Vec3> &points : {c.points(n, 7), c.mesh.vertices})
    for (const Vec3 &q : points)
      for (int k = 0; k < 3; k++) out.push_back(static_cast<T>(q[k]));
  for (const double x : {1e151, -3e300, HUGE_VAL, std::nan("")})
    out.insert(out.end(), {static_cast<T>(x), 1, 0});
  return out;
}

// The first is larger than a block's threads take.
const std::vector<std::unique_ptr<TreeCase>> &all_cases()
{
  static const auto made =
      cases_of<TreeCase>({cylinder_mesh(100, 49, 50, 100), box_mesh({0, 0, 0}, {1, 2, 3})}, 100);
  return made;
}

// Arrays of all answers, on the host or on a GPU.
template <class T>
struct Answers {
  DeviceArray<T> points, radii, distance, closest, normal, barycentric, signed_distance;
  DeviceArray<std::uint32_t> triangle, feature;
  DeviceArray<std::int8_t> side;
  DeviceArray<std::uint8_t> status;
  PointArrays<T> io;

  Answers(bool cuda, const std::vector<T> &at) :
      points(cuda), radii(cuda), distance(cuda), closest(cuda), normal(cuda), barycentric(cuda),
      signed_distance(cuda), triangle(cuda), feature(cuda), side(cuda), status(cuda)
  {
    io.n = at.size() / 3;
    io.points = {points.put(at), 3, 1};
    io.radius = kAnyDistance;
    io.distance = {distance.resize(io.n), 1};
    io.closest = {closest.resize(3 * io.n), 3, 1};
    io.normal = {normal.resize(3 * io.n), 3, 1};
    io.barycentric = {barycentric.resize(3 * io.n), 3, 1};
    io.triangle = triangle.resize(io.n);
    io.feature = feature.resize(io.n);
    io.status = status.resize(io.n);
  }
};

template <class T>
void expect_same_bits(const std::vector<T> &a, const std::vector<T> &b, const TreeCase &c)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); i++)
    ASSERT_TRUE(a[i] == b[i] || (a[i] != a[i] && b[i] != b[i]))
        << c.soup.source << ", " << i << ": " << a[i] << ", on the CPU " << b[i];
}

template <class T>
void expect_the_same_answers(Real radius, bool each)
{
  for (const auto &c : all_cases()) {
    const std::vector<T> at = coordinates<T>(*c, 500);
    Answers<T> gpu(true, at), cpu(false, at);
    const std::size_t n = cpu.io.n;
    std::vector<T> radii;
    for (std::size_t i = 0; i < n; i++)
      radii.push_back(static_cast<T>(radius * c->diagonal * (i % 7) / 3));
    for (Answers<T> *a : {&gpu, &cpu}) {
      if (radius > 0) a->io.radius = static_cast<T>(radius * c->diagonal);
      if (each) a->io.radii = {a->radii.put(radii), 1};
    }
    copy_to_cuda(c->tree)->query_on(nullptr)->enqueue(gpu.io);
    query_tree(c->tree, nullptr, HUGE_VAL, cpu.io);
    expect_same_bits(gpu.distance.get(n), cpu.distance.get(n), *c);
    expect_same_bits(gpu.feature.get(n), cpu.feature.get(n), *c);
    expect_same_bits(gpu.triangle.get(n), cpu.triangle.get(n), *c);
    expect_same_bits(gpu.status.get(n), cpu.status.get(n), *c);
    expect_same_bits(gpu.closest.get(3 * n), cpu.closest.get(3 * n), *c);
    expect_same_bits(gpu.normal.get(3 * n), cpu.normal.get(3 * n), *c);
    expect_same_bits(gpu.barycentric.get(3 * n), cpu.barycentric.get(3 * n), *c);
  }
}

TEST(tree_on_gpu, gives_the_bits_of_the_cpu_at_any_distance_and_within_radii)
{
  expect_the_same_answers<double>(0, false);
  expect_the_same_answers<double>(0.1, false);
  expect_the_same_answers<double>(0.1, true);
  expect_the_same_answers<float>(0, false);
}

// More than one turn of 2^20, each put in order.
TEST(tree_on_gpu, very_many_points_get_what_each_alone_gets)
{
  const TreeCase &c = *all_cases()[0];
  const std::vector<float> at = coordinates<float>(c, (1 << 20) + 100);
  Answers<float> gpu(true, at), cpu(false, at);
  const std::size_t n = cpu.io.n;
  for (Answers<float> *a : {&gpu, &cpu}) a->io.radius = static_cast<float>(1e-3 * c.diagonal);
  copy_to_cuda(c.tree)->query_on(nullptr)->enqueue(gpu.io);
  query_tree(c.tree, nullptr, HUGE_VAL, cpu.io);
  expect_same_bits(gpu.distance.get(n), cpu.distance.get(n), c);
  expect_same_bits(gpu.feature.get(n), cpu.feature.get(n), c);
}

// Winding numbers are exact. A point is left out where rounding cannot tell it from one on the mesh: as near as
// a sum of three products is off, of numbers that are each off by 2 units, where the largest coordinate is far
// larger than the mesh, too.
TEST(tree_on_gpu, normals_tell_the_sides_that_winding_numbers_tell)
{
  std::size_t inside = 0;
  for (const auto &c : all_cases()) {
    if (!c->mesh.report.closed || !c->mesh.report.oriented) continue;
    if (meets_itself(c->mesh).pairs > 0) continue;
    const std::vector<double> at = coordinates<double>(*c, 2000);
    Answers<double> gpu(true, at);
    const std::size_t n = gpu.io.n;
    gpu.io.side = gpu.side.resize(n);
    gpu.io.signed_distance = {gpu.signed_distance.resize(n), 1};
    copy_to_cuda(c->tree)->query_on(nullptr)->enqueue(gpu.io);
    const std::vector<std::int8_t> side = gpu.side.get(n);
    const std::vector<double> distance = gpu.distance.get(n),
                              with_sign = gpu.signed_distance.get(n);
    const std::vector<std::uint32_t> triangle = gpu.triangle.get(n);
    const WindingNumber winding(c->mesh);
    for (std::size_t i = 0; i + 2 < n; i++) {
      if (distance[i] < 32 * kRoundoff * (c->diagonal + c->size)) continue;
      if (triangle[i] == kNoTriangle) {    // of facets without area, which have no side
        ASSERT_EQ(side[i], 0);
        ASSERT_TRUE(std::isnan(with_sign[i]));
        continue;
      }
      ASSERT_EQ(side[i], winding.side({at[3 * i], at[3 * i + 1], at[3 * i + 2]}));
      ASSERT_EQ(with_sign[i], side[i] * distance[i]);
      inside += side[i] < 0;
    }
    EXPECT_EQ(side[n - 2], 0);
  }
  EXPECT_GT(inside, 100u);
}

TEST(tree_on_gpu, refuses_a_negative_radius_by_its_point)
{
  const TreeCase &c = *all_cases()[1];
  Answers<double> gpu(true, {0, 0, 5, 0, 0, 6, 0, 0, 7});
  gpu.io.radii = {gpu.radii.put({1., 1., -2.}), 1};
  const auto query = copy_to_cuda(c.tree)->query_on(nullptr);
  try {
    query->enqueue(gpu.io);
    FAIL();
  } catch (const InputError &e) {
    EXPECT_STREQ(e.what(), "point 2 has radius -2: give 0 or more");
  }
}

}    // namespace
}    // namespace lsdcd
