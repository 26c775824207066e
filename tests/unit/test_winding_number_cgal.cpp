// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sides of points at real meshes and at unions of them that overlap, against CGAL's exact ones.
// LSDCD_POINTS sets how many points each mesh has; LSDCD_TIMES=1 prints what they take.
#include "mesh/winding_number.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/real_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using SideOf = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

constexpr long kBlock = 1000;

long n_points()
{
  const char *n = std::getenv("LSDCD_POINTS");
  return n ? std::atol(n) : 20000;
}

// A closed mesh for CGAL.
struct Shell {
  Mesh mesh;
  std::unique_ptr<SideOf> side_of;

  explicit Shell(const TriangleSoup &soup)
  {
    const WeldedMesh welded = weld(soup, 0);
    EXPECT_TRUE(welded.report.closed) << soup.source;
    for (const Vec3 &x : welded.vertices) mesh.add_vertex({x.x, x.y, x.z});
    const auto vertex = [](int v) { return Mesh::Vertex_index(v); };
    for (const auto &f : welded.faces)
      EXPECT_NE(mesh.add_face(vertex(f[0]), vertex(f[1]), vertex(f[2])), Mesh::null_face());
    side_of = std::make_unique<SideOf>(mesh);
    (*side_of)(Kernel::Point_3(0, 0, 0));    // builds its tree
  }
};

// Every second point anywhere, the others on vertices and edges and from 0 to 1e-3 diagonals off them.
Vec3 random_point(Random &random, const TriangleSoup &soup, const Box &box)
{
  const Vec3 size = box.hi - box.lo, middle = 0.5 * box.lo + 0.5 * box.hi;
  if (random() % 2) {
    Vec3 q = middle;
    for (int k = 0; k < 3; k++) q[k] += size[k] * uniform(random, -0.6, 0.6);
    return q;
  }
  const std::size_t t = 3 * (random() % soup.n_triangles()), k = random() % 3;
  const Vec3 a = soup.corners[t + k], b = soup.corners[t + (k + 1) % 3];
  Vec3 q = random() % 2 ? a : a + uniform(random, 0, 1) * (b - a);
  if (random() % 8 == 0) return q;
  const Real away = norm(size) * std::pow(10., uniform(random, -17, -3));
  for (int d = 0; d < 3; d++)
    if (random() % 4) q[d] += away * uniform(random, -1, 1);
  return q;
}

void expect_sides_of_CGAL(const std::vector<TriangleSoup> &parts)
{
  TriangleSoup soup;
  std::deque<Shell> shells;    // where they are made: CGAL keeps their addresses
  for (const TriangleSoup &part : parts) {
    append(soup, part);
    shells.emplace_back(part);
  }
  soup.source = "union";
  Box box = {soup.corners[0], soup.corners[0]};
  for (const Vec3 &x : soup.corners) extend(box, x);
  const WeldedMesh mesh = weld(soup, 0);
  const WindingNumber winding(mesh);
  long wrong = 0, inside = 0, on = 0;
  double seconds = 0;
  for (long block = 0; block < n_points() / kBlock; block++) {
    Random random(block);
    std::vector<Vec3> points;
    for (long i = 0; i < kBlock; i++) points.push_back(random_point(random, soup, box));
    const auto start = std::chrono::steady_clock::now();
    std::vector<WindingNumber::Answer> ours;
    for (const Vec3 &q : points) ours.push_back(winding.at(q));
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (long i = 0; i < kBlock; i++) {
      const Vec3 &q = points[i];
      bool is_on = false;
      int number = 0;
      for (const Shell &shell : shells) {
        const CGAL::Bounded_side side = (*shell.side_of)({q.x, q.y, q.z});
        is_on = is_on || side == CGAL::ON_BOUNDARY;
        number += side == CGAL::ON_BOUNDED_SIDE;
      }
      on += is_on;
      inside += !is_on && number > 0;
      wrong += ours[i].on_surface != is_on || (!is_on && std::abs(ours[i].number) != number);
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, n_points() / 20);
  EXPECT_GT(on, n_points() / 100);
  std::printf("%zu triangles: %ld points, %ld inside, %ld on the surface, %ld wrong",
              soup.n_triangles(), n_points(), inside, on, wrong);
  if (std::getenv("LSDCD_TIMES"))
    std::printf(", %.0f ns a point", 1e9 * seconds / static_cast<double>(n_points()));
  std::printf("\n");
}

TriangleSoup real(const std::string &name)
{
  TriangleSoup soup = read_real_mesh(name, LSDCD_UNPACKED);
  centre(soup, 1);
  return soup;
}

class RealMesh : public testing::TestWithParam<const char *> {};

TEST_P(RealMesh, has_the_sides_of_CGAL)
{
  expect_sides_of_CGAL({real(GetParam())});
}
INSTANTIATE_TEST_SUITE_P(real, RealMesh,
                         testing::Values("elephant", "fandisk", "armadillo", "knot1", "bear"));

TEST(union_of_real_meshes, has_the_sides_of_CGAL)
{
  expect_sides_of_CGAL({real("elephant"), moved(real("fandisk"), {0.2, 0.1, 0}),
                        moved(real("knot1"), {-0.1, 0, 0.2})});
}

}    // namespace
}    // namespace lsdcd

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  if (!lsdcd::has_real_meshes()) {
    std::printf("skipped: %s is missing; install libcgal-demo\n", lsdcd::kRealMeshes);
    return 77;
  }
  return RUN_ALL_TESTS();
}
