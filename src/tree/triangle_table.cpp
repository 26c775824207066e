// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree/triangle_table.h"

#include "mesh/welded_mesh.h"

#include <algorithm>

namespace lsdcd {

TriangleTable::TriangleTable(const WeldedMesh &mesh) :
    of_face(mesh.face_facet.begin(), mesh.face_facet.end()),
    of_edge(mesh.edges.size(), kNoTriangle), of_vertex(mesh.vertices.size(), kNoTriangle)
{
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    for (int k = 0; k < 3; k++) {
      std::uint32_t &edge = of_edge[mesh.face_edges[f][k]], &vertex = of_vertex[mesh.faces[f][k]];
      edge = std::min(edge, of_face[f]);
      vertex = std::min(vertex, of_face[f]);
    }
}

}    // namespace lsdcd
