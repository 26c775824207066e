// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Closest points on the copies of features in the frame of a brick, in float.
#pragma once

#include "contact/mesh_geometry.h"
#include "grid/lookup/brick_words.h"

namespace lsdcd {

// The tests of closest_point.h on records whose coordinates are small:
// p is the sphere's centre in the frame of its brick.
class BrickGeometry {
 public:
  using Candidates = FullCandidates;    // of complete lists

  LSDCD_FN BrickGeometry(const GridView &grid, const Vec3 &q, const CellAddress &at) :
      grid_(grid), q_(q), p_(vec_cast<float>(at.from_centre + from_brick_centre(grid, at.cell))),
      tolerance_(static_cast<float>(tolerance(grid)))
  {
  }
  // Only for points inside the grid.
  LSDCD_FN BrickGeometry(const GridView &grid, const Vec3 &q) :
      BrickGeometry(grid, q, address_inside(grid, q))
  {
  }

  // A bound of the rounding error of a height over a plane: 16 units in the last place of the largest
  // coordinate in a brick's frame, which is the cutoff plus half the brick's diagonal (7 cells).
  LSDCD_FN static Real tolerance(const GridView &grid)
  {
    constexpr Real kFloatRoundoff = 5.9604644775390625e-8;
    return grid.tolerance + 16 * kFloatRoundoff * (grid.cutoff + 14 * grid.length);
  }
  LSDCD_FN Real tolerance() const { return tolerance_; }

  LSDCD_FN FeatureCode feature(FeatureCode code) const
  {
    const std::uint32_t i = feature_index(code);
    switch (feature_kind(code)) {
      case FeatureKind::face:
        return feature_code(FeatureKind::face, grid_.records.face_of[i]);
      case FeatureKind::edge:
        return feature_code(FeatureKind::edge, grid_.records.edge_of[i]);
      default:
        return feature_code(FeatureKind::vertex, grid_.records.vertex_of[i]);
    }
  }

  LSDCD_FN ClosestPoint closest_point(FeatureCode code, Real within,
                                      const FeatureRecord * = nullptr) const
  {
    return closest_point_with(code, within, 0);
  }
  LSDCD_FN static void prefetch(const GridView &, const Candidates &, std::uint32_t, std::uint32_t)
  {
  }
  // Could there be a closest point if the tolerance were larger by `more` (length)?
  LSDCD_FN bool may_be_closest(FeatureCode code, Real within, Real more) const
  {
    return closest_point_with(code, within, more).found;
  }

  LSDCD_FN const FaceParts &parts(FeatureCode face) const
  {
    return grid_.records.face_parts[feature_index(face)];
  }

  LSDCD_FN FaceRegion over(FeatureCode face, Real within) const
  {
    const BrickFace f = grid_.records.faces[feature_index(face)];
    if (!(fabs(height(f.plane)) <= static_cast<float>(within))) return FaceRegion::far;
    return over_sides(f, tolerance_);
  }

 private:
  LSDCD_FN ClosestPoint closest_point_with(FeatureCode code, Real within, Real more) const
  {
    const std::uint32_t i = feature_index(code);
    const float limit = static_cast<float>(within),
                tolerance = tolerance_ + static_cast<float>(more);
    switch (feature_kind(code)) {
      case FeatureKind::face:
        return on_face(i, tolerance, limit);
      case FeatureKind::edge:
        return on_edge(grid_.records.edges[i], tolerance, limit);
      default:
        return on_vertex(grid_.records.vertices[i], tolerance, limit);
    }
  }

  LSDCD_FN static Vec3 from_brick_centre(const GridView &grid, std::int32_t cell)
  {
    const Real middle = Real(0.5) * (kBrickSide - 1);
    return grid.length * Vec3{(cell & 7) - middle, (cell >> 3 & 7) - middle, (cell >> 6) - middle};
  }

  LSDCD_FN float height(const BrickPlane &plane) const
  {
    return dot(plane.normal, p_) + plane.offset;
  }

  LSDCD_FN FaceRegion over_sides(const BrickFace &f, float tolerance) const
  {
    const float a = height(f.side[0]), b = height(f.side[1]), c = height(f.side[2]);
    if (!(a >= -tolerance && b >= -tolerance && c >= -tolerance)) return FaceRegion::outside;
    return a < tolerance || b < tolerance || c < tolerance ? FaceRegion::rim : FaceRegion::inside;
  }

  // Forces and springs need a normal of length 1 in double.
  LSDCD_FN static ClosestPoint closest_along(const Vec3f &normal, float distance)
  {
    const Vec3 n = vec_cast<Real>(normal);
    return {true, static_cast<Real>(distance), (1 / norm(n)) * n};
  }

  LSDCD_FN ClosestPoint on_face(std::uint32_t i, float tolerance, float within) const
  {
    const BrickFace f = grid_.records.faces[i];
    const float h = height(f.plane);
    const FaceRegion over = over_sides(f, tolerance);
    // Both are read before a branch, so that a GPU loads the whole record at once.
    if (!(fabs(h) <= within) | (over == FaceRegion::outside)) return kNoClosestPoint;
    if (over == FaceRegion::rim) {
      Vec3 corner[3];
      for (int k = 0; k < 3; k++) {
        const FaceVertices &v = grid_.wall.face_vertex[grid_.records.face_of[i]];
        corner[k] = grid_.wall.vertices[v.v[k]].position;
      }
      if (!before_corners(corner, q_, tolerance)) return kNoClosestPoint;
    }
    return closest_along(h < 0 ? -f.plane.normal : f.plane.normal, fabs(h));
  }

  LSDCD_FN ClosestPoint on_edge(const BrickEdge e, float tolerance, float within) const
  {
    const Vec3f d = p_ - e.anchor;
    const float along = dot(e.direction, d);
    if (!(along >= e.lo - tolerance && along <= e.hi + tolerance)) return kNoClosestPoint;
    if (e.n_faces > 0 && !(dot(e.inward[0], d) <= tolerance)) return kNoClosestPoint;
    if (e.n_faces > 1 && !(dot(e.inward[1], d) <= tolerance)) return kNoClosestPoint;
    for (std::uint32_t k = 2; k < e.n_faces; k++)
      if (!(dot(grid_.records.edge_inward[e.more + k - 2], d) <= tolerance)) return kNoClosestPoint;
    const Vec3f radial = d - along * e.direction;
    const float distance = norm(radial);
    if (!(distance <= within)) return kNoClosestPoint;
    if (distance > kOnWall) return closest_along((1 / distance) * radial, distance);
    Vec3f away = {0, 0, 0};
    if (e.n_faces > 0) away -= e.inward[0];
    if (e.n_faces > 1) away -= e.inward[1];
    if (norm(away) > kFlatFan) return closest_along((1 / norm(away)) * away, 0);
    if (e.n_faces > 0) return closest_along(cross(e.direction, e.inward[0]), 0);
    return {true, 0, any_perpendicular(vec_cast<Real>(e.direction))};
  }

  LSDCD_FN ClosestPoint on_vertex(const BrickVertex &v, float tolerance, float within) const
  {
    const Vec3f d = p_ - v.position;
    const float distance = norm(d);
    if (!(distance <= within)) return kNoClosestPoint;
    Vec3f away = {0, 0, 0};
    for (std::uint32_t k = v.first; k < v.first + v.count; k++) {
      const Vec3f direction = grid_.records.vertex_direction[k];
      if (!(dot(direction, d) <= tolerance)) return kNoClosestPoint;
      away -= direction;
    }
    if (distance > kOnWall) return closest_along((1 / distance) * d, distance);
    if (norm(away) > kFlatFan) return closest_along((1 / norm(away)) * away, 0);
    const Vec3f along = v.count > 0 ? grid_.records.vertex_direction[v.first] : away;
    return {true, 0, any_perpendicular(vec_cast<Real>(along))};
  }

  static constexpr float kOnWall = 1e-18f;    // squares leave the range of float below
  static constexpr float kFlatFan = 1e-5f;

  const GridView &grid_;
  const Vec3 &q_;
  Vec3f p_;
  float tolerance_;
};

}    // namespace lsdcd
