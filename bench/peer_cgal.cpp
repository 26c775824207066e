// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// CGAL's AABB tree. It has no radius to stop at: what is farther costs it more.
#include "peers.h"

#if defined(LSDCD_BENCH_CGAL)
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>

#include <cmath>
#include <memory>

namespace lsdcd {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Searched {
  Triangles triangles;
  Tree tree;
};

PeerQuery build(const TriangleSoup &mesh)
{
  const auto made = std::make_shared<Searched>();
  for (std::size_t t = 0; t < mesh.n_triangles(); t++) {
    Kernel::Point_3 at[3];
    for (int k = 0; k < 3; k++) {
      const Vec3 &x = mesh.corners[3 * t + k];
      at[k] = {x.x, x.y, x.z};
    }
    made->triangles.emplace_back(at[0], at[1], at[2]);
  }
  made->tree.rebuild(made->triangles.cbegin(), made->triangles.cend());
  made->tree.accelerate_distance_queries();
  return [made](const Sphere *spheres, std::size_t n, double *distance) {
    for (std::size_t i = 0; i < n; i++) {
      const Sphere &s = spheres[i];
      const double d = std::sqrt(made->tree.squared_distance({s.x, s.y, s.z}));
      distance[i] = d < s.r ? d : HUGE_VAL;
    }
  };
}

}    // namespace

Peer cgal()
{
  return {"CGAL " CGAL_VERSION_STR ", double", build, "libcgal-dev", 1e5};
}

}    // namespace lsdcd

#else

namespace lsdcd {

Peer cgal()
{
  return {"CGAL", nullptr, "libcgal-dev", 0};
}

}    // namespace lsdcd

#endif
