// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distance from a point to a primitive of the wall: a whole triangle, or a bare edge or vertex.
#pragma once

#include "base/vec3.h"
#include "geometry/wall_records.h"

namespace lsdcd {

LSDCD_FN Real segment_distance(const Vec3 &a, const Vec3 &b, const Vec3 &q)
{
  const Vec3 along = b - a, d = q - a;
  const Real length_sq = norm_sq(along), t = dot(along, d);
  if (!(t > 0) || !(length_sq > 0)) return norm(d);
  if (t >= length_sq) return norm(q - b);
  return norm(d - (t / length_sq) * along);
}

// Returns the distance from q to a triangle (figure 5 of the paper). That q lies over it is decided by its three sides, in place of
// the paper's formula (5), which is wrong where an angle is obtuse. Exact, with no division by an area. Where q lies outside one side of the triangle, the
// nearest point is on that side; outside two, on one of the two.
LSDCD_FN Real triangle_distance(const MeshFeaturesView &wall, std::uint32_t face, const Vec3 &q)
{
  const FaceRecord &f = wall.faces[face];
  const Vec3 d = q - f.anchor;
  const Real side[3] = {dot(f.inward[0], d), dot(f.inward[1], d) + f.height, dot(f.inward[2], d)};
  if (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) return fabs(dot(f.normal, d));
  Real least = -1;
  for (int k = 0; k < 3; k++) {
    if (side[k] >= 0) continue;
    const Vec3 a = wall.vertices[wall.face_vertex[face].v[k]].position,
               b = wall.vertices[wall.face_vertex[face].v[(k + 1) % 3]].position;
    const Real distance = segment_distance(a, b, q);
    if (least < 0 || distance < least) least = distance;
  }
  return least;
}

// The points that these distances are to.
LSDCD_FN Vec3 nearest_on_segment(const Vec3 &a, const Vec3 &b, const Vec3 &q)
{
  const Vec3 along = b - a;
  const Real length_sq = norm_sq(along), t = dot(along, q - a);
  if (!(t > 0) || !(length_sq > 0)) return a;
  return t >= length_sq ? b : a + (t / length_sq) * along;
}

LSDCD_FN Vec3 nearest_on_triangle(const MeshFeaturesView &wall, std::uint32_t face, const Vec3 &q)
{
  const FaceRecord &f = wall.faces[face];
  const Vec3 d = q - f.anchor;
  const Real side[3] = {dot(f.inward[0], d), dot(f.inward[1], d) + f.height, dot(f.inward[2], d)};
  Vec3 nearest = q - dot(f.normal, d) * f.normal;
  Real least = -1;
  for (int k = 0; k < 3; k++) {
    if (side[k] >= 0) continue;
    const Vec3 a = wall.vertices[wall.face_vertex[face].v[k]].position,
               b = wall.vertices[wall.face_vertex[face].v[(k + 1) % 3]].position,
               there = nearest_on_segment(a, b, q);
    const Real distance = norm(q - there);
    if (least >= 0 && !(distance < least)) continue;
    least = distance;
    nearest = there;
  }
  return nearest;
}

LSDCD_FN Real primitive_distance(const MeshFeaturesView &wall, FeatureCode primitive, const Vec3 &q)
{
  const std::uint32_t i = feature_index(primitive);
  switch (feature_kind(primitive)) {
    case FeatureKind::face:
      return triangle_distance(wall, i, q);
    case FeatureKind::edge:
      return segment_distance(wall.vertices[wall.edge_vertex[i].v[0]].position,
                              wall.vertices[wall.edge_vertex[i].v[1]].position, q);
    default:
      return norm(q - wall.vertices[i].position);
  }
}

}    // namespace lsdcd
