// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/weld_map.h"

#include "mesh/hash_index.h"

#include <algorithm>

namespace lsdcd {

namespace {

// The face with these three corners.
int face_with(const WeldedMesh &mesh, const int *corner)
{
  for (int i = mesh.vertex_first[corner[0]]; i < mesh.vertex_first[corner[0] + 1]; i++) {
    const int e = mesh.vertex_edge[i];
    const std::array<int, 2> &ends = mesh.edges[e];
    if (ends[0] != corner[1] && ends[1] != corner[1]) continue;
    for (int k = mesh.edge_first[e]; k < mesh.edge_first[e + 1]; k++) {
      const std::array<int, 3> &face = mesh.faces[mesh.edge_face[k]];
      if (std::find(face.begin(), face.end(), corner[2]) != face.end()) return mesh.edge_face[k];
    }
  }
  return kNoFace;
}

}    // namespace

std::vector<int> faces_of_facets(const WeldedMesh &mesh, const std::vector<int> &corner_vertex)
{
  std::vector<int> face_of(corner_vertex.size() / 3, kNoFace);
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    face_of[mesh.face_facet[f]] = static_cast<int>(f);
  for (std::size_t t = 0; t < face_of.size(); t++) {
    const int *corner = &corner_vertex[3 * t];
    const bool is_line = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
    if (face_of[t] == kNoFace && !is_line) face_of[t] = face_with(mesh, corner);
  }
  return face_of;
}

std::vector<int> vertices_at(const std::vector<Vec3> &places, const std::vector<Vec3> &corners,
                             const std::vector<int> &corner_vertex)
{
  // -0.0 becomes 0.0, which has other bits.
  const auto hash = [](const Vec3 &x) { return hash_three(x.x + 0, x.y + 0, x.z + 0); };
  HashIndex table;
  for (std::size_t k = 0; k < corners.size(); k++)
    table.find_or_insert(hash(corners[k]), static_cast<int>(k),
                         [&](int i) { return corners[i] == corners[k]; });
  std::vector<int> vertex;
  vertex.reserve(places.size());
  for (const Vec3 &place : places) {
    const int k = table.find(hash(place), [&](int i) { return corners[i] == place; });
    vertex.push_back(k == HashIndex::kNone ? kNoVertex : corner_vertex[k]);
  }
  return vertex;
}

}    // namespace lsdcd
