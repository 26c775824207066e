// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where on a face, edge or vertex the distance to a point has a local minimum.
#pragma once

#include "base/vec3.h"
#include "geometry/wall_records.h"

namespace lsdcd {

// The local minimum of the distance from q to one feature, if there is one.
struct ClosestPoint {
  bool found;       // false: the rest is not set
  Real distance;    // length, >= 0
  Vec3 normal;      // unit, wall -> q; a fixed one where q lies on the wall
};

// Each of the three tests has a tolerance `tolerance` (length) that widens the
// region of space in which the feature is a local minimum, so that neighbouring
// regions overlap and no point falls between them. With tolerance = 0 they are the
// exact regions: face prism, edge wedge, vertex cone. Closest points farther than `within`
// (length) are not found.
constexpr Real kAnyDistance = 1e300;
// Below this length squares leave the range of Real: the centre counts as on the wall.
constexpr Real kNoDistance = 1e-140;
constexpr ClosestPoint kNoClosestPoint = {false, 0, {0, 0, 0}};

// Tests of a record are joined by &, not by &&, so that a GPU's thread first reads the whole record
// and waits for memory once.

// `at_rim` is set if the closest point may lie past a side, by at most the tolerance or the rounding
// that it covers.
LSDCD_FN ClosestPoint closest_on_face(const FaceRecord &face, const Vec3 &q, Real tolerance,
                                      Real within, bool &at_rim)
{
  const Vec3 d = q - face.anchor;
  const Real h = dot(face.normal, d);
  const Real a = dot(face.inward[0], d), b = dot(face.inward[1], d) + face.height,
             c = dot(face.inward[2], d);
  if (!((fabs(h) <= within) & (a >= -tolerance) & (b >= -tolerance) & (c >= -tolerance)))
    return kNoClosestPoint;
  at_rim = a < tolerance || b < tolerance || c < tolerance;
  if (h < 0) return {true, -h, -face.normal};
  return {true, h, face.normal};
}

// At a sharp corner the widened sides meet far past the face, by tolerance / sin(half
// its angle). Is q past such a corner by no more than the tolerance, along its bisector?
// A closest point is then within sqrt(2) tolerances of the face, at any corner.
LSDCD_FN bool before_corners(const Vec3 *corner, const Vec3 &q, Real tolerance)
{
  for (int k = 0; k < 3; k++) {
    const Vec3 u = corner[(k + 1) % 3] - corner[k], v = corner[(k + 2) % 3] - corner[k];
    if (!(dot(u, v) > 0)) continue;
    const Vec3 bisector = (1 / norm(u)) * u + (1 / norm(v)) * v;
    if (!(dot(bisector, q - corner[k]) >= -tolerance * norm(bisector))) return false;
  }
  return true;
}

// Is the point at d from an edge's anchor past that edge, for its first two faces? For the other
// faces?
LSDCD_FN bool inside_first_two(const EdgeRecord &edge, const Vec3 &d, Real tolerance)
{
  return ((edge.n_faces < 1) | (dot(edge.inward[0], d) <= tolerance)) &
         ((edge.n_faces < 2) | (dot(edge.inward[1], d) <= tolerance));
}
LSDCD_FN bool inside_others(const EdgeRecord &edge, const Vec3 *edge_inward, const Vec3 &d,
                            Real tolerance)
{
  for (std::uint32_t k = 2; k < edge.n_faces; k++)
    if (!(dot(edge_inward[edge.more + k - 2], d) <= tolerance)) return false;
  return true;
}

LSDCD_FN ClosestPoint closest_on_edge(const EdgeRecord &edge, const Vec3 *edge_inward,
                                      const Vec3 &q, Real tolerance, Real within = kAnyDistance)
{
  const Vec3 d = q - edge.anchor;
  const Real along = dot(edge.direction, d);
  const bool may = (along >= -tolerance) & (along <= edge.length + tolerance) &
                   inside_first_two(edge, d, tolerance);
  if (!may || !inside_others(edge, edge_inward, d, tolerance)) return kNoClosestPoint;
  const Vec3 radial = d - along * edge.direction;
  const Real distance = norm(radial);
  if (!(distance <= within)) return kNoClosestPoint;
  if (distance > kNoDistance) return {true, distance, (1 / distance) * radial};
  // q is on the edge: the normal points away from its faces, or is that of a flat pair.
  Vec3 away = {0, 0, 0};
  if (edge.n_faces > 0) away -= edge.inward[0];
  if (edge.n_faces > 1) away -= edge.inward[1];
  const Real length = norm(away);
  if (length > Real(1e-6)) return {true, 0, (1 / length) * away};
  if (edge.n_faces > 0) return {true, 0, cross(edge.direction, edge.inward[0])};
  return {true, 0, any_perpendicular(edge.direction)};
}

LSDCD_FN bool inside_cone(const VertexRecord &vertex, const Vec3 *direction, const Vec3 &d,
                          Real tolerance)
{
  for (std::uint32_t k = 0; k < vertex.count; k++)
    if (!(dot(direction[vertex.first + k], d) <= tolerance)) return false;
  return true;
}

LSDCD_FN ClosestPoint closest_on_vertex(const VertexRecord &vertex, const Vec3 *direction,
                                        const Vec3 &q, Real tolerance, Real within = kAnyDistance)
{
  const Vec3 d = q - vertex.position;
  const Real distance = norm(d);
  if (!(distance <= within) || !inside_cone(vertex, direction, d, tolerance))
    return kNoClosestPoint;
  if (distance > kNoDistance) return {true, distance, (1 / distance) * d};
  // q is on the vertex: the normal points away from its edges, or is perpendicular to one if they are flat.
  Vec3 away = {0, 0, 0};
  for (std::uint32_t k = 0; k < vertex.count; k++) away -= direction[vertex.first + k];
  const Real length = norm(away);
  if (length > Real(1e-6)) return {true, 0, (1 / length) * away};
  return {true, 0, any_perpendicular(vertex.count > 0 ? direction[vertex.first] : away)};
}

// Is q within `tolerance` of the region in which a feature is a local minimum of distance, and the
// feature within `within`? True wherever closest_on_face(), closest_on_edge() or closest_on_vertex()
// finds one, and past sharp corners of faces. It takes no root and no division.
LSDCD_FN bool may_be_closest(const MeshFeaturesView &wall, FeatureCode feature, const Vec3 &q,
                             Real tolerance, Real within)
{
  const std::uint32_t i = feature_index(feature);
  const Real within_sq = within * within;
  switch (feature_kind(feature)) {
    case FeatureKind::face: {
      const FaceRecord &face = wall.faces[i];
      const Vec3 d = q - face.anchor;
      return (fabs(dot(face.normal, d)) <= within) & (dot(face.inward[0], d) >= -tolerance) &
             (dot(face.inward[1], d) + face.height >= -tolerance) &
             (dot(face.inward[2], d) >= -tolerance);
    }
    case FeatureKind::edge: {
      const EdgeRecord &edge = wall.edges[i];
      const Vec3 d = q - edge.anchor;
      const Real along = dot(edge.direction, d);
      const bool may = (along >= -tolerance) & (along <= edge.length + tolerance) &
                       inside_first_two(edge, d, tolerance) &
                       (norm_sq(d - along * edge.direction) <= within_sq);
      return may && inside_others(edge, wall.edge_inward, d, tolerance);
    }
    default: {
      const Vec3 d = q - wall.vertices[i].position;
      return norm_sq(d) <= within_sq &&
             inside_cone(wall.vertices[i], wall.vertex_direction, d, tolerance);
    }
  }
}

// `copy`: of the feature's record, or null.
LSDCD_FN ClosestPoint closest_point_on(const MeshFeaturesView &wall, FeatureCode feature,
                                       const Vec3 &q, Real tolerance, Real within = kAnyDistance,
                                       const FeatureRecord *copy = nullptr)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face: {
      bool at_rim = false;
      const FaceRecord &face = copy ? copy->face : wall.faces[i];
      const ClosestPoint closest = closest_on_face(face, q, tolerance, within, at_rim);
      if (!closest.found || !at_rim) return closest;
      Vec3 corner[3];
      for (int k = 0; k < 3; k++) corner[k] = wall.vertices[wall.face_vertex[i].v[k]].position;
      if (before_corners(corner, q, tolerance)) return closest;
      return kNoClosestPoint;
    }
    case FeatureKind::edge:
      return closest_on_edge(copy ? copy->edge : wall.edges[i], wall.edge_inward, q, tolerance,
                             within);
    default:
      return closest_on_vertex(copy ? copy->vertex : wall.vertices[i], wall.vertex_direction, q,
                               tolerance, within);
  }
}

}    // namespace lsdcd
