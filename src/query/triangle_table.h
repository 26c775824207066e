// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The triangles of the file that features of a mesh belong to.
#pragma once

#include "base/real.h"
#include "geometry/feature_code.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

struct WallMesh;

// The mesh's triangle that a feature of the wall is, or that has the feature; kNoTriangle: none.
constexpr std::uint32_t kNoTriangle = 0xffffffffu;
struct TriangleNames {
  const std::uint32_t *of_face, *of_edge, *of_vertex;

  LSDCD_FN std::uint32_t of(FeatureCode feature) const
  {
    const std::uint32_t i = feature_index(feature);
    switch (feature_kind(feature)) {
      case FeatureKind::face:
        return of_face[i];
      case FeatureKind::edge:
        return of_edge[i];
      default:
        return of_vertex[i];
    }
  }
};

// The triangle of the mesh for each feature of the wall, by its number in the file; of several the
// lowest.
struct TriangleTable {
  std::vector<std::uint32_t> of_face, of_edge, of_vertex;

  explicit TriangleTable(const WallMesh &mesh);
  TriangleNames view() const { return {of_face.data(), of_edge.data(), of_vertex.data()}; }
};

}    // namespace lsdcd
