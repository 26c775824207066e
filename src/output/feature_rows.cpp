// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/feature_rows.h"

#include <cstdint>

namespace lsdcd {

std::vector<int> faces_at(const WeldedMesh &mesh, FeatureCode feature)
{
  const std::uint32_t i = feature_index(feature);
  std::vector<int> faces;
  const auto add_edge = [&](int e) {
    faces.insert(faces.end(), mesh.edge_face.begin() + mesh.edge_first[e],
                 mesh.edge_face.begin() + mesh.edge_first[e + 1]);
  };
  if (feature_kind(feature) == FeatureKind::face) return {static_cast<int>(i)};
  if (feature_kind(feature) == FeatureKind::edge)
    add_edge(static_cast<int>(i));
  else
    for (int k = mesh.vertex_first[i]; k < mesh.vertex_first[i + 1]; k++)
      add_edge(mesh.vertex_edge[k]);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}    // namespace lsdcd
