// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The features of a mesh near a place, for a grain that stays near it.
#pragma once

#include "base/vec3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Faces by their planes, and those edges and vertices of which all faces are among them, or which have none. An edge within a
// flat patch, and a vertex within one, is left out: the minimum over a plane is not there alone.
struct NearFeatures {
  // The numbers of faces are of the planes before it and its own, so that they end there.
  struct Plane {
    Vec3 normal, point;
    Vec3 lo, hi;    // of the box around its faces
    std::uint32_t rim_end, inner_end;
    std::uint32_t
        likely;    // of its inner faces, the one that had the minimum; it changes the time alone
  };
  // A face with an edge or vertex that is listed. Numbers are places in the lists below; that of one that is not in them is the
  // size of its list.
  struct RimFace {
    std::uint32_t primitive;    // of the tree
    std::uint32_t edge[3], vertex[3];
  };
  struct Edge {
    std::uint32_t edge, vertex[2];    // of the mesh, and places in the list of vertices
  };
  std::vector<Plane> planes;
  std::vector<RimFace> rim;
  std::vector<std::uint32_t> inner;    // other faces, primitives of the tree
  std::vector<Edge> edges;
  std::vector<std::uint32_t> vertices;    // of the mesh
  std::vector<std::uint32_t> bare;        // primitives that are edges and vertices without a face

  std::size_t n_faces() const { return rim.size() + inner.size(); }
  void clear()
  {
    planes.clear();
    rim.clear();
    inner.clear();
    edges.clear();
    vertices.clear();
    bare.clear();
  }
  std::size_t bytes() const
  {
    return planes.capacity() * sizeof(Plane) + rim.capacity() * sizeof(RimFace) +
           edges.capacity() * sizeof(Edge) +
           (inner.capacity() + vertices.capacity() + bare.capacity()) * sizeof(std::uint32_t);
  }
};

}    // namespace lsdcd
