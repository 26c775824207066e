// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The box of a feature, along the axes.
#pragma once

#include "base/vec3.h"
#include "geometry/wall_records.h"

namespace lsdcd {

LSDCD_FN void grow_box(Vec3 &lo, Vec3 &hi, const Vec3 &p)
{
  for (int k = 0; k < 3; k++) {
    if (p[k] < lo[k]) lo[k] = p[k];
    if (p[k] > hi[k]) hi[k] = p[k];
  }
}

LSDCD_FN void feature_box(const MeshFeaturesView &wall, FeatureCode feature, Vec3 &lo, Vec3 &hi)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      lo = hi = wall.vertices[wall.face_vertex[i].v[0]].position;
      grow_box(lo, hi, wall.vertices[wall.face_vertex[i].v[1]].position);
      grow_box(lo, hi, wall.vertices[wall.face_vertex[i].v[2]].position);
      return;
    case FeatureKind::edge:
      lo = hi = wall.vertices[wall.edge_vertex[i].v[0]].position;
      grow_box(lo, hi, wall.vertices[wall.edge_vertex[i].v[1]].position);
      return;
    default:
      lo = hi = wall.vertices[i].position;
  }
}

}    // namespace lsdcd
