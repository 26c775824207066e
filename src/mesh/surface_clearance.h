// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Whether a point is clear of a surface, at any distance.
#pragma once

#include "geometry/primitive_distance.h"
#include "mesh/box_tree.h"
#include "mesh/wall_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd {

class SurfaceClearance {
 public:
  explicit SurfaceClearance(const WallMesh &mesh) :
      features_(make_features(mesh, false, true)), tree_(boxes_of(features_))
  {
  }

  // Is all of the surface, also edges and points of facets without area, at least this far away?
  bool is_clear(const Vec3 &q, Real gap) const
  {
    const WallFeaturesView wall = features_.view();
    return tree_.least(
               gap, [&](const Box &box) { return distance(box, q); },
               [&](int i) { return primitive_distance(wall, features_.primitives[i], q); }) >= gap;
  }

  std::size_t bytes() const
  {
    return tree_.bytes() + features_.faces.capacity() * sizeof(FaceRecord) +
           features_.edges.capacity() * sizeof(EdgeRecord) +
           features_.vertices.capacity() * sizeof(VertexRecord);
  }

 private:
  static Real distance(const Box &box, const Vec3 &q)
  {
    Real sum = 0;
    for (int d = 0; d < 3; d++) {
      const Real out = std::max({box.lo[d] - q[d], q[d] - box.hi[d], Real(0)});
      sum += out * out;
    }
    return std::sqrt(sum);
  }
  static std::vector<Box> boxes_of(const WallFeatures &features)
  {
    const WallFeaturesView wall = features.view();
    const auto at = [&](int v) { return wall.vertices[v].position; };
    std::vector<Box> boxes;
    for (const FeatureCode code : features.primitives) {
      const std::uint32_t i = feature_index(code);
      if (feature_kind(code) == FeatureKind::face) {
        const FaceVertices &f = wall.face_vertex[i];
        boxes.push_back(box_around(at(f.v[0]), at(f.v[1]), at(f.v[2])));
      } else if (feature_kind(code) == FeatureKind::edge) {
        const EdgeVertices &e = wall.edge_vertex[i];
        boxes.push_back(box_around(at(e.v[0]), at(e.v[1]), at(e.v[1])));
      } else {
        boxes.push_back({at(i), at(i)});
      }
    }
    return boxes;
  }

  WallFeatures features_;
  BoxTree tree_;
};

}    // namespace lsdcd
