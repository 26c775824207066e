// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The triangles of the file that features of a mesh belong to.
#pragma once

#include "base/real.h"
#include "geometry/feature_code.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

struct WeldedMesh;

// The mesh's triangle that a feature of the wall is, or that has the feature; kNoTriangle: none.
constexpr std::uint32_t kNoTriangle = 0xffffffffu;
struct TriangleNames {
  const std::uint32_t *of_face, *of_edge, *of_vertex;    // the first ascends
  std::uint32_t n_faces;

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
  // The face of a triangle that has one.
  LSDCD_FN std::uint32_t face_of(std::uint32_t triangle) const
  {
    std::uint32_t from = 0, to = n_faces;
    while (to - from > 1) {
      const std::uint32_t middle = from + (to - from) / 2;
      if (of_face[middle] <= triangle)
        from = middle;
      else
        to = middle;
    }
    return from;
  }
};

// The triangle of the mesh for each feature of the wall, by its number in the file: the lowest that has the
// feature.
struct TriangleTable {
  std::vector<std::uint32_t> of_face, of_edge, of_vertex;

  explicit TriangleTable(const WeldedMesh &mesh);
  TriangleNames view() const
  {
    return {of_face.data(), of_edge.data(), of_vertex.data(),
            static_cast<std::uint32_t>(of_face.size())};
  }
};

}    // namespace lsdcd
