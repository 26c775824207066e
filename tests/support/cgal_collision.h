// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of triangles that meet, by CGAL's AABB tree with exact predicates.
#pragma once

#include "bodies/body_collision.h"
#include "mesh/welded_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

namespace lsdcd {

// Collisions of triangles with an area.
class CgalCollision {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

 public:
  explicit CgalCollision(const WeldedMesh &wall)
  {
    for (const auto &f : wall.faces)
      faces_.push_back(triangle(wall.vertices[f[0]], wall.vertices[f[1]], wall.vertices[f[2]]));
    tree_.insert(faces_.begin(), faces_.end());
    tree_.build();
  }

  std::vector<BodyPair> collide(const TriangleSoup &body, const BodyPose &pose) const
  {
    std::vector<BodyPair> pairs;
    std::vector<Primitive::Id> met;
    for (std::uint32_t t = 0; t < body.n_triangles(); t++) {
      const Vec3 *c = &body.corners[3 * std::size_t(t)];
      met.clear();
      tree_.all_intersected_primitives(
          triangle(pose.corner_at(c[0]), pose.corner_at(c[1]), pose.corner_at(c[2])),
          std::back_inserter(met));
      for (const auto &id : met)
        pairs.push_back({t, static_cast<FeatureCode>(id - faces_.begin())});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

 private:
  static Kernel::Triangle_3 triangle(const Vec3 &a, const Vec3 &b, const Vec3 &c)
  {
    const auto point = [](const Vec3 &p) { return Kernel::Point_3(p.x, p.y, p.z); };
    return Kernel::Triangle_3(point(a), point(b), point(c));
  }
  Triangles faces_;
  Tree tree_;
};

}    // namespace lsdcd
