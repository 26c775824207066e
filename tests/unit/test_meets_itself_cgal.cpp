// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Facets of one mesh that meet, against CGAL's self-intersections with exact predicates.
#include "mesh/meets_itself.h"
#include "support/meshes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lsdcd {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

std::size_t pairs_of_cgal(const WeldedMesh &mesh)
{
  Mesh m;
  for (const Vec3 &x : mesh.vertices) m.add_vertex(Point(x.x, x.y, x.z));
  const auto vertex = [](int v) { return Mesh::Vertex_index(v); };
  for (const auto &f : mesh.faces) {
    const auto added = m.add_face(vertex(f[0]), vertex(f[1]), vertex(f[2]));
    EXPECT_NE(added, Mesh::null_face());
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(m, std::back_inserter(pairs));
  return pairs.size();
}

// Closed frusta of two fans and long facets, whose rims are folded. More faces than those of which pairs are taken by boxes alone.
TEST(meets_itself, has_the_pairs_of_CGAL_in_fans_and_among_long_facets)
{
  std::mt19937_64 dice(7);
  const Vec3 x = {0.36, 0.48, -0.8}, y = {-0.8, 0.6, 0}, z = cross(x, y);
  std::size_t pairs = 0;
  for (int k = 0; k < 60; k++) {
    const int n = 150;
    const Real step = 2 * std::acos(Real(-1)) / n, height = k % 3 == 0 ? 0.01 : 0.5;
    std::uniform_real_distribution<Real> off(-1, 1);
    std::vector<Vec3> rim[2];
    for (const int upper : {0, 1})
      for (int i = 0; i < n; i++) {
        const Real t = step * (i + (k % 4) * off(dice)), r = upper ? 0.7 : 1,
                   rise = k % 2 ? step * off(dice) : 0;
        rim[upper].push_back(r * (std::cos(t) * x + std::sin(t) * y) + (upper * height + rise) * z);
      }
    TriangleSoup soup;
    for (int i = 0; i < n; i++) {
      const int j = (i + 1) % n;
      const Vec3 &a = rim[0][i], &b = rim[0][j], &c = rim[1][i], &d = rim[1][j];
      for (const Vec3 &corner : {Vec3{0, 0, 0}, b, a, a, b, d, a, d, c, height * z, c, d})
        soup.corners.push_back(corner);
    }
    const WeldedMesh mesh = weld(soup, 0);
    const SelfMeetings found = meets_itself(mesh);
    EXPECT_EQ(found.pairs, pairs_of_cgal(mesh)) << k;
    pairs += found.pairs;
  }
  EXPECT_GT(pairs, 1000u);
}

// On a lattice corners lie on facets, edges cross edges, and facets lie in common planes.
TEST(meets_itself, has_the_pairs_of_CGAL_where_vertices_are_on_a_lattice_and_where_they_are_not)
{
  std::mt19937_64 dice(3);
  std::size_t pairs = 0;
  for (int k = 0; k < 300; k++) {
    const int n = 4, side = k % 3 == 0 ? 3 : 5;
    std::vector<Vec3> lattice, x;
    for (int i = 0; i < side * side * side; i++)
      lattice.push_back({Real(i % side), Real(i / side % side), Real(i / side / side)});
    std::shuffle(lattice.begin(), lattice.end(), dice);
    std::uniform_real_distribution<Real> anywhere(-0.4, 0.4);
    for (int i = 0; i < n * n; i++)
      x.push_back(k % 3 == 2 ? lattice[i] + Vec3{anywhere(dice), anywhere(dice), anywhere(dice)}
                             : lattice[i]);
    const WeldedMesh mesh = weld(crumpled_torus(x, n), 0);
    const SelfMeetings found = meets_itself(mesh);
    EXPECT_EQ(found.pairs, pairs_of_cgal(mesh)) << k;
    pairs += found.pairs;
  }
  EXPECT_GT(pairs, 10000u);
}

// Shells that do not meet themselves: all pairs are of both.
TEST(meets_itself, shells_have_the_pairs_of_CGAL)
{
  std::mt19937_64 dice(4);
  std::uniform_real_distribution<Real> anywhere(-1.5, 1.5);
  std::size_t pairs = 0;
  for (int k = 0; k < 100; k++) {
    TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
    for (int i = 0; i < 3; i++) {
      const Vec3 at = {anywhere(dice), anywhere(dice), anywhere(dice)};
      append(soup, box_mesh(at, at + Vec3{1, 2, 0.5}));
    }
    const WeldedMesh mesh = weld(soup, 0);
    EXPECT_EQ(mesh.report.meeting_pairs, pairs_of_cgal(mesh)) << k;
    pairs += mesh.report.meeting_pairs;
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(meets_itself, finds_none_in_a_closed_box)
{
  EXPECT_EQ(meets_itself(weld(box_mesh({0, 0, 0}, {1, 2, 3}), -1)).pairs, 0u);
}

}    // namespace
}    // namespace lsdcd
