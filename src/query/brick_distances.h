// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances to the copies of features in the frame of a brick, in float.
#pragma once

#include "contact/mesh_geometry.h"
#include "grid/lookup/brick_words.h"

namespace lsdcd {

// Position of a point over a face: too far from its plane, past a side, within the tolerance of a side, or inside.
enum class FaceRegion { far, outside, rim, inside };

// The tests of closest_point.h, on records with small coordinates: p is the point in the frame of its brick. A primitive
// has a distance if the wall has a local minimum of distance on it: past a side that two faces share, the neighbour has
// it.
class BrickDistances {
 public:
  static constexpr bool kFloats = true;

  LSDCD_FN BrickDistances(const GridView &grid, const Vec3 &q, const CellAddress &at) :
      grid_(grid), q_(q), p_(vec_cast<float>(at.from_centre + from_brick_centre(grid, at.cell))),
      tolerance_(static_cast<float>(tolerance(grid)))
  {
  }

  // Returns a bound of the rounding error of a height over a plane: 16 units in the last place of the largest coordinate
  // in a brick's frame, which is the cutoff plus half the brick's diagonal (7 cells).
  LSDCD_FN static Real tolerance(const GridView &grid)
  {
    constexpr Real kFloatRoundoff = 5.9604644775390625e-8;
    return grid.tolerance + 16 * kFloatRoundoff * (grid.cutoff + 14 * grid.length);
  }

  LSDCD_FN Real primitive(FeatureCode code, Real within) const
  {
    if (feature_kind(code) != FeatureKind::face) return feature(code, within);
    const std::uint32_t i = feature_index(code);
    const FaceRegion over = this->over(grid_.records.faces[i], static_cast<float>(within));
    if (over == FaceRegion::far) return kAnyDistance;
    Real nearest = over == FaceRegion::outside ? kAnyDistance : feature(code, within);
    if (over == FaceRegion::inside) return nearest;
    for (FeatureCode part : grid_.records.face_parts[i].part)
      if (part != kNoFeature) nearest = fmin(nearest, feature(part, within));
    return nearest;
  }
  LSDCD_FN Real feature(FeatureCode code, Real within) const
  {
    const std::uint32_t i = feature_index(code);
    const float limit = static_cast<float>(within);
    switch (feature_kind(code)) {
      case FeatureKind::face:
        return to_face(i, limit);
      case FeatureKind::edge:
        return to_edge(grid_.records.edges[i], limit);
      default:
        return to_vertex(grid_.records.vertices[i], limit);
    }
  }

 private:
  LSDCD_FN static Vec3 from_brick_centre(const GridView &grid, std::int32_t cell)
  {
    const Real middle = Real(0.5) * (kBrickSide - 1);
    return grid.length * Vec3{(cell & 7) - middle, (cell >> 3 & 7) - middle, (cell >> 6) - middle};
  }

  LSDCD_FN float height(const BrickPlane &plane) const
  {
    return dot(plane.normal, p_) + plane.offset;
  }

  LSDCD_FN FaceRegion over(const BrickFace &f, float within) const
  {
    if (!(fabs(height(f.plane)) <= within)) return FaceRegion::far;
    return over_sides(f);
  }

  LSDCD_FN FaceRegion over_sides(const BrickFace &f) const
  {
    const float a = height(f.side[0]), b = height(f.side[1]), c = height(f.side[2]);
    if (!(a >= -tolerance_ && b >= -tolerance_ && c >= -tolerance_)) return FaceRegion::outside;
    return a < tolerance_ || b < tolerance_ || c < tolerance_ ? FaceRegion::rim
                                                              : FaceRegion::inside;
  }

  LSDCD_FN Real to_face(std::uint32_t i, float within) const
  {
    const BrickFace f = grid_.records.faces[i];
    const float h = height(f.plane);
    const FaceRegion over = over_sides(f);
    // Both are read before a branch, so that a GPU loads the whole record at once.
    if (!(fabs(h) <= within) | (over == FaceRegion::outside)) return kAnyDistance;
    if (over == FaceRegion::rim) {
      Vec3 corner[3];
      for (int k = 0; k < 3; k++) {
        const FaceVertices &v = grid_.wall.face_vertex[grid_.records.face_of[i]];
        corner[k] = grid_.wall.vertices[v.v[k]].position;
      }
      if (!before_corners(corner, q_, tolerance_)) return kAnyDistance;
    }
    return fabs(h);
  }

  LSDCD_FN Real to_edge(const BrickEdge e, float within) const
  {
    const Vec3f d = p_ - e.anchor;
    const float along = dot(e.direction, d);
    if (!(along >= e.lo - tolerance_ && along <= e.hi + tolerance_)) return kAnyDistance;
    if (e.n_faces > 0 && !(dot(e.inward[0], d) <= tolerance_)) return kAnyDistance;
    if (e.n_faces > 1 && !(dot(e.inward[1], d) <= tolerance_)) return kAnyDistance;
    for (std::uint32_t k = 2; k < e.n_faces; k++)
      if (!(dot(grid_.records.edge_inward[e.more + k - 2], d) <= tolerance_)) return kAnyDistance;
    return distance_of(norm(d - along * e.direction), within);
  }

  LSDCD_FN Real to_vertex(const BrickVertex &v, float within) const
  {
    const Vec3f d = p_ - v.position;
    const float distance = norm(d);
    if (!(distance <= within)) return kAnyDistance;
    for (std::uint32_t k = v.first; k < v.first + v.count; k++)
      if (!(dot(grid_.records.vertex_direction[k], d) <= tolerance_)) return kAnyDistance;
    return distance_of(distance, within);
  }

  LSDCD_FN static Real distance_of(float distance, float within)
  {
    constexpr float kOnWall = 1e-18f;    // below this, squares leave the range of float
    if (!(distance <= within)) return kAnyDistance;
    return distance > kOnWall ? distance : 0;
  }

  const GridView &grid_;
  const Vec3 &q_;
  Vec3f p_;
  float tolerance_;
};

}    // namespace lsdcd
