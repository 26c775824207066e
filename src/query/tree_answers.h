// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input and output of a tree's query for each point, on the CPU and on a GPU.
#pragma once

#include "query/point_work.h"
#include "tree/tree_view.h"

namespace lsdcd {

template <class T>
struct TreeAnswers {
  TreeView tree;
  PointArrays<T> io;
  TooLarge<SphereOf<T>> too_large;
  bool only_distance;

  // Returns the radius of a point that was scaled to be `times` nearer.
  LSDCD_FN Real radius(std::size_t i, Real times) const
  {
    const Real r = io.radii.at ? static_cast<Real>(io.radii[i]) : io.radius;
    return r < kAnyDistance ? r / times : r;
  }
  LSDCD_FN void check(std::size_t i) const
  {
    if (io.radii.at) too_large.note(i, SphereOf<T>{0, 0, 0, io.radii[i]});
  }
  // Writes the answer of q, which was found for q / times.
  LSDCD_FN void store(std::size_t i, const Vec3 &q, const TreeAnswer &a, Real times) const
  {
    const Real distance = a.found() ? times * a.distance : HUGE_VAL;
    if (io.status) io.status[i] = (a.found() ? kFound : 0) | kCertified;
    if (io.distance.at) io.distance[i] = static_cast<T>(distance);
    if (!only_distance) store_nearest(i, q, (1 / times) * q, a, distance);
  }

 private:
  LSDCD_FN void store_nearest(std::size_t i, const Vec3 &q, const Vec3 &nearer, const TreeAnswer &a,
                              Real distance) const
  {
    Vec3 point = q, normal = {0, 0, 0};
    const bool needs_point = io.closest.at || io.normal.at || io.barycentric.at || io.needs_side();
    if (a.found() && needs_point) tree.closest(a, nearer, point, normal);
    io.store(i, a.feature, point, normal, parts());
    if (io.needs_side())
      io.store_side(i, distance, a.found() ? tree.side(a, nearer, point, normal) : 0);
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
