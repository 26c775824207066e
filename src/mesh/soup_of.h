// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The triangles of a mesh without their neighbours, to be placed or sent, and welded again.
#pragma once

#include "mesh/welded_mesh.h"

namespace lsdcd {

// Faces in their order, then facets that are none; then edges and vertices without a face, as triangles without area.
TriangleSoup soup_of(const WeldedMesh &mesh);

// Calls add(a, b, c) for each edge and vertex that no face has, as a triangle without area.
template <class Add>
void for_bare_parts(const WeldedMesh &mesh, const Add &add)
{
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (mesh.edge_first[e] == mesh.edge_first[e + 1])
      add(mesh.edges[e][0], mesh.edges[e][1], mesh.edges[e][1]);
  for (std::size_t v = 0; v < mesh.vertices.size(); v++)
    if (mesh.vertex_first[v] == mesh.vertex_first[v + 1]) {
      const int point = static_cast<int>(v);
      add(point, point, point);
    }
}

}    // namespace lsdcd
