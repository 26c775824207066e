// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points all over a mesh: nowhere are they farther apart than asked, against random places on its faces.
#include "mesh/surface_points.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lsdcd::test_surface_points {
namespace {

constexpr std::size_t kMany = 1000000;

WeldedMesh box(const Vec3 &size)
{
  return weld(box_mesh({0, 0, 0}, size), -1);
}

}    // namespace

TEST(surface_points, are_the_vertices_where_edges_are_short)
{
  EXPECT_EQ(surface_points(box({1, 1, 1}), 1.5, kMany).size(), 8u);
}

// Diagonals of 6 faces of side 1 are 1.41 long.
TEST(surface_points, are_the_middles_of_edges_that_are_too_long)
{
  const std::vector<Vec3> points = surface_points(box({1, 1, 1}), 1, kMany);
  ASSERT_EQ(points.size(), 14u);
  for (std::size_t i = 8; i < points.size(); i++) {
    int in_the_middle = 0;
    for (int k = 0; k < 3; k++) in_the_middle += points[i][k] == 0.5;
    EXPECT_EQ(in_the_middle, 2);
  }
}

TEST(surface_points, are_within_a_root_of_a_third_of_what_is_asked)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<Real> part(0, 1);
  for (const Vec3 &size : {Vec3{1, 1, 1}, Vec3{1, 0.03, 0.4}}) {
    const WeldedMesh mesh = box(size);
    for (const Real apart : {0.7, 0.11, 0.05}) {
      const std::vector<Vec3> points = surface_points(mesh, apart, kMany);
      Real farthest = 0;
      for (int n = 0; n < 3000; n++) {
        const auto &f = mesh.faces[n % mesh.faces.size()];
        Real u = part(random), v = part(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 &a = mesh.vertices[f[0]];
        const Vec3 x = a + u * (mesh.vertices[f[1]] - a) + v * (mesh.vertices[f[2]] - a);
        Real nearest = HUGE_VAL;
        for (const Vec3 &p : points) nearest = std::min(nearest, norm(p - x));
        farthest = std::max(farthest, nearest);
      }
      EXPECT_LE(farthest, apart / std::sqrt(3.)) << apart;
      EXPECT_GE(farthest, apart / 8) << apart;
    }
  }
}

TEST(surface_points, are_each_there_once)
{
  std::vector<Vec3> points = surface_points(box({1, 0.7, 0.3}), 0.1, kMany);
  const auto before = [](const Vec3 &a, const Vec3 &b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::sort(points.begin(), points.end(), before);
  for (std::size_t i = 1; i < points.size(); i++) EXPECT_GT(norm(points[i] - points[i - 1]), 0.01);
}

TEST(surface_points, are_none_where_they_would_be_too_many)
{
  EXPECT_TRUE(surface_points(box({1, 1, 1}), 0.2, 1000).size() > 100);
  EXPECT_TRUE(surface_points(box({1, 1, 1}), 0.01, 1000).empty());
}

}    // namespace lsdcd::test_surface_points
