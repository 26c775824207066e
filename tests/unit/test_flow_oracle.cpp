// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Passes against CGAL in rational numbers, where the vector by which all centres are moved for
// ties is a true number: coordinates are whole numbers below 16, so that determinants are whole
// numbers below 1e6, and 1e-9 is less than any of them.
#include "flow/flow_surface.h"
#include "support/meshes.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include <random>

namespace lsdcd {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

// Moved as path.h says: by (e, e^2, e^3).
Point shifted(const Vec3 &x)
{
  const Kernel::FT e = Kernel::FT(1) / 1000000000;
  return Point(x.x + e, x.y + e * e, x.z + e * e * e);
}

Vec3 whole(std::mt19937 &random, int n)
{
  return {Real(random() % n), Real(random() % n), Real(random() % n)};
}

// The hull of random whole points: closed, with many facets in one plane.
TriangleSoup hull(std::mt19937 &random, Mesh &mesh)
{
  std::vector<Point> points;
  for (int i = 0; i < 12; i++) {
    const Vec3 p = whole(random, 8);
    points.push_back(Point(p.x, p.y, p.z));
  }
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  TriangleSoup soup;
  soup.source = "hull";
  for (const auto face : mesh.faces())
    for (const auto vertex : vertices_around_face(mesh.halfedge(face), mesh)) {
      const Point &p = mesh.point(vertex);
      soup.corners.push_back(
          {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
  return soup;
}

TEST(flow_oracle, net_passes_are_those_from_inside_to_outside)
{
  std::mt19937 random(1);
  long ties = 0, passed = 0;
  for (int n = 0; n < 20; n++) {
    Mesh mesh;
    const TriangleSoup soup = hull(random, mesh);
    const FlowSurface surface(weld(soup, 0));
    const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
    const auto inside = [&](const Vec3 &x) { return side(shifted(x)) == CGAL::ON_BOUNDED_SIDE; };
    Vec3 at = whole(random, 8);
    for (int step = 0; step < 400; step++) {
      const Vec3 next = whole(random, 8);
      const int expected = int(inside(at)) - int(inside(next));
      EXPECT_EQ(surface.passes({at}, next, PeriodicBox()).net(), expected)
          << at.x << " " << at.y << " " << at.z << " to " << next.x << " " << next.y << " "
          << next.z;
      ties += side(Point(next.x, next.y, next.z)) == CGAL::ON_BOUNDARY;
      passed += expected != 0;
      at = next;
    }
  }
  EXPECT_GT(ties, 200);
  EXPECT_GT(passed, 400);
}

// An open heap of triangles: each that the moved path meets, and on which side it began.
TEST(flow_oracle, every_triangle_is_passed_as_by_the_moved_path)
{
  std::mt19937 random(2);
  long passed = 0, through_edges = 0;
  for (int n = 0; n < 3000; n++) {
    TriangleSoup soup;
    const Vec3 p[3] = {whole(random, 5), whole(random, 5), whole(random, 5)};
    if (norm(cross(p[1] - p[0], p[2] - p[0])) == 0) continue;
    soup.corners = {p[0], p[1], p[2]};
    const FlowSurface surface(weld(soup, 0));
    const Point a(p[0].x, p[0].y, p[0].z), b(p[1].x, p[1].y, p[1].z), c(p[2].x, p[2].y, p[2].z);
    for (int k = 0; k < 10; k++) {
      const Vec3 from = whole(random, 5), to = whole(random, 5);
      if (from == to) continue;
      const Point begin = shifted(from), end = shifted(to);
      const bool meets =
          CGAL::do_intersect(Kernel::Segment_3(begin, end), Kernel::Triangle_3(a, b, c));
      const int expected = !meets ? 0 : CGAL::orientation(a, b, c, end) == CGAL::POSITIVE ? 1 : -1;
      EXPECT_EQ(surface.passes({from}, to, PeriodicBox()).net(), expected);
      passed += meets;
      const Kernel::Segment_3 path(Point(from.x, from.y, from.z), Point(to.x, to.y, to.z));
      through_edges += CGAL::do_intersect(path, Kernel::Segment_3(a, b));
    }
  }
  EXPECT_GT(passed, 1000);
  EXPECT_GT(through_edges, 1000);
}

}    // namespace
}    // namespace lsdcd
