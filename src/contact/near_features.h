// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The features of a mesh near a place, kept for a grain that stays near it.
#pragma once

#include "base/vec3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Faces, sorted by their planes, and the edges and vertices whose faces are all among them, or that have no face. An edge or a
// vertex inside a flat patch is left out, because the minimum over a plane is never at it alone.
struct NearFeatures {
  // A plane with its faces. The numbers of faces are counted over the planes up to and including this one, so they say where
  // its faces end.
  struct Plane {
    Vec3 normal, point;
    Vec3 lo, hi;    // of the box around its faces
    std::uint32_t rim_end, inner_end;
    // The face that had the minimum, and its place if it is a face of the rim. They change only the time.
    std::uint32_t likely, likely_rim;
  };
  // A face with an edge or vertex that is listed. Its edges and vertices are places in the lists below; one that is not listed
  // has the size of the list as its place.
  struct RimFace {
    std::uint32_t primitive;    // of the tree
    std::uint32_t plane;
    std::uint32_t edge[3], vertex[3];
  };
  // A face of the rim, and which side or corner of it an edge or vertex is.
  struct PartOfFace {
    std::uint32_t rim, k;
  };
  // The faces at all edges, or at all vertices that can have a contact, one after the other.
  struct FacesAt {
    std::vector<PartOfFace> parts;
    std::vector<std::uint32_t> end;    // end of the faces of each edge or vertex

    std::size_t begin_of(std::size_t i) const { return i > 0 ? end[i - 1] : 0; }
    void clear()
    {
      parts.clear();
      end.clear();
    }
    std::size_t bytes() const
    {
      return parts.capacity() * sizeof(PartOfFace) + end.capacity() * sizeof(std::uint32_t);
    }
  };
  struct Edge {
    std::uint32_t edge, vertex[2];    // number in the mesh, and places in the list of vertices
    bool is_likely;    // it was a contact when it was last tested; it changes only the time
  };
  std::vector<Plane> planes;
  std::vector<RimFace> rim;
  std::vector<std::uint32_t> inner;    // other faces, as primitives of the tree
  std::vector<Edge> edges;
  // Vertices of the mesh: the first n_whole can have a contact, the others are only ends of edges.
  std::vector<std::uint32_t> vertices;
  std::size_t n_whole = 0;
  FacesAt faces_at_edge, faces_at_vertex;
  std::vector<std::uint32_t> bare;    // primitives that are edges or vertices without a face

  std::uint32_t rim_begin(std::size_t plane) const
  {
    return plane > 0 ? planes[plane - 1].rim_end : 0;
  }
  std::uint32_t inner_begin(std::size_t plane) const
  {
    return plane > 0 ? planes[plane - 1].inner_end : 0;
  }
  std::size_t n_faces() const { return rim.size() + inner.size(); }
  void clear()
  {
    planes.clear();
    rim.clear();
    inner.clear();
    edges.clear();
    vertices.clear();
    n_whole = 0;
    faces_at_edge.clear();
    faces_at_vertex.clear();
    bare.clear();
  }
  std::size_t bytes() const
  {
    return planes.capacity() * sizeof(Plane) + rim.capacity() * sizeof(RimFace) +
           edges.capacity() * sizeof(Edge) + faces_at_edge.bytes() + faces_at_vertex.bytes() +
           (inner.capacity() + vertices.capacity() + bare.capacity()) * sizeof(std::uint32_t);
  }
};

}    // namespace lsdcd
