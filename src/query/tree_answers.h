// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a tree's query reads of each point, and what it writes of the answer, on the CPU and on a GPU.
#pragma once

#include "query/point_work.h"
#include "query/tree_view.h"

namespace lsdcd {

template <class T>
struct TreeAnswers {
  TreeView tree;
  PointArrays<T> io;
  TooLarge<SphereOf<T>> too_large;
  bool only_distance;

  // Of the point so many times nearer.
  LSDCD_FN Real radius(std::size_t i, Real times) const
  {
    const Real r = io.radii.at ? static_cast<Real>(io.radii[i]) : io.radius;
    return r < kAnyDistance ? r / times : r;
  }
  LSDCD_FN void check(std::size_t i) const
  {
    if (io.radii.at) too_large.note(i, SphereOf<T>{0, 0, 0, io.radii[i]});
  }
  // The answer of a point `times` nearer than q.
  LSDCD_FN void keep(std::size_t i, const Vec3 &q, const TreeAnswer &a, Real times) const
  {
    const Real distance = a.found() ? times * a.distance : HUGE_VAL;
    if (io.status) io.status[i] = (a.found() ? kTouching : 0) | kCertified;
    if (io.distance.at) io.distance[i] = static_cast<T>(distance);
    if (!only_distance) keep_nearest(i, q, (1 / times) * q, a, distance);
  }

 private:
  LSDCD_FN void keep_nearest(std::size_t i, const Vec3 &q, const Vec3 &nearer, const TreeAnswer &a,
                             Real distance) const
  {
    Vec3 point = q, normal = {0, 0, 0};
    const bool needs_point =
        io.closest.at || io.normal.at || io.barycentric.at || io.side || io.signed_distance.at;
    if (a.found() && needs_point) tree.closest(a, nearer, point, normal);
    if (io.closest.at) io.closest.put(i, point);
    if (io.normal.at) io.normal.put(i, normal);
    if (io.feature) io.feature[i] = a.feature;
    if (io.triangle) io.triangle[i] = a.found() ? tree.names.of(a.feature) : kNoTriangle;
    if (io.barycentric.at) io.barycentric.put(i, parts().barycentric(a.feature, point));
    if (!io.side && !io.signed_distance.at) return;
    const std::int8_t side = a.found() ? tree.side(a, nearer, point, normal) : 0;
    if (io.side) io.side[i] = side;
    if (io.signed_distance.at)
      io.signed_distance[i] = static_cast<T>(signed_distance(distance, side));
  }
  struct Position {
    const Vec3 *vertices;
    LSDCD_FN Vec3 operator()(int v) const { return vertices[v]; }
  };
  LSDCD_FN MeshParts<Position> parts() const
  {
    return {tree.names, tree.faces, tree.edges, {tree.vertices}};
  }
};

}    // namespace lsdcd
