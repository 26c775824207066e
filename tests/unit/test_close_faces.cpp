// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of faces that are close enough to be tested: all that meet are among them, and they are few where boxes overlap all.
#include "mesh/close_faces.h"

#include "geometry/triangles_meet.h"
#include "mesh/meets_itself.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace lsdcd {
namespace {

enum class Kind { disc, cone, slantwise, book };
constexpr Kind kKinds[] = {Kind::disc, Kind::cone, Kind::slantwise, Kind::book};

// With n facets along a rim, turned so that no edge is along an axis. `fold`: how far corners of the rim may be off, in distances of
// neighbours.
WeldedMesh mesh_of(Kind kind, int n, Real fold, std::mt19937_64 &dice)
{
  const Vec3 x = {0.36, 0.48, -0.8}, y = {-0.8, 0.6, 0}, z = cross(x, y);
  std::uniform_real_distribution<Real> off(-fold, fold);
  const Real height = 0.3, step = 2 * std::acos(Real(-1)) / n;
  std::vector<Vec3> lower, upper;
  for (int i = 0; i < n; i++) {
    const Real t = step * (i + off(dice)), rise = step * off(dice);
    lower.push_back(std::cos(t) * x + std::sin(t) * y + rise * z);
    upper.push_back(Real(1.5) * (std::cos(t) * x + std::sin(t) * y) + height * z);
  }
  const Vec3 middle = {0, 0, 0}, tip = height * z;
  TriangleSoup soup;
  const auto add = [&](const Vec3 &a, const Vec3 &b, const Vec3 &c) {
    soup.corners.insert(soup.corners.end(), {a, b, c});
  };
  for (int i = 0; i < n; i++) {
    const int j = (i + 1) % n;
    if (kind == Kind::disc || kind == Kind::cone) add(middle, lower[j], lower[i]);
    if (kind == Kind::cone) add(tip, lower[i], lower[j]);
    if (kind == Kind::slantwise) {
      add(lower[i], lower[j], upper[j]);
      add(lower[i], upper[j], upper[i]);
    }
    if (kind == Kind::book) add(middle, tip, lower[i]);
  }
  return weld(soup, 0);
}

std::vector<int> all_faces(const WeldedMesh &mesh)
{
  std::vector<int> all(mesh.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// The rims are folded, so that facets cut their neighbours.
TEST(close_faces, have_each_pair_of_triangles_without_a_common_corner_that_meets)
{
  std::mt19937_64 dice(5);
  std::size_t meeting = 0;
  for (int k = 0; k < 24; k++) {
    const WeldedMesh mesh = mesh_of(kKinds[k % 4], 100, 3, dice);
    std::set<std::pair<int, int>> close;
    CloseFaces(mesh, all_faces(mesh)).visit_pairs([&](int f, int g) {
      EXPECT_TRUE(close.emplace(std::min(f, g), std::max(f, g)).second) << f << " " << g;
    });
    const int n = static_cast<int>(mesh.faces.size());
    const auto triangle = [&](int f) {
      const auto &v = mesh.faces[f];
      return Triangle{{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
    };
    for (int f = 0; f < n; f++)
      for (int g = f + 1; g < n; g++) {
        bool apart = true;
        for (const int v : mesh.faces[f])
          for (const int w : mesh.faces[g]) apart &= v != w;
        if (!apart || !triangles_meet(triangle(f), triangle(g))) continue;
        meeting++;
        EXPECT_TRUE(close.count({f, g})) << f << " " << g;
      }
  }
  EXPECT_GT(meeting, 100u);
}

// All pairs would be 500 to 2 000 for each face.
TEST(close_faces, are_few_in_fans_and_among_long_facets_that_lie_slantwise)
{
  std::mt19937_64 dice(1);
  for (const Kind kind : kKinds) {
    const WeldedMesh mesh = mesh_of(kind, 1000, 0, dice);
    std::size_t pairs = 0;
    CloseFaces(mesh, all_faces(mesh)).visit_pairs([&](int, int) { pairs++; });
    EXPECT_LT(pairs, 12 * mesh.faces.size()) << static_cast<int>(kind);
    EXPECT_EQ(meets_itself(mesh).pairs, 0u) << static_cast<int>(kind);
  }
}

}    // namespace
}    // namespace lsdcd
