// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Can a sphere centred near a point have a contact on a feature?
#pragma once

#include "geometry/wall_records.h"

namespace lsdcd {

// The region in which a feature is a local minimum of distance (face prism, edge wedge,
// vertex cone) is an intersection of half-spaces. A point that moves by `around` goes no
// farther across any of them, so each test is relaxed by that much and no contact is
// lost. If two half-spaces meet at a sharp angle, the relaxed pair reaches far past the
// relaxed region. Every weighted sum of the two conditions holds as well, and the
// half-space of their sum cuts that spike off.
//
// Each function returns whether a point within `around` of c can lie in the region and
// within `cutoff` of the feature. If so, `distance` becomes the distance of c from the
// feature's plane, line or point. All are lengths.

// The largest square of a sum of two conditions that is above 0; the normal of their half-space has
// length sqrt(length_sq). If that is short, rounding decides its direction, and it is not tested.
LSDCD_FN Real square_of_past(Real length_sq, Real around)
{
  constexpr Real kShort = 1e-12, kAny = 1.7976931348623157e308;
  return length_sq > kShort ? around * around * length_sq : kAny;
}
LSDCD_FN bool is_past(Real sum, Real length_sq, Real around)
{
  return sum > 0 && sum * sum > square_of_past(length_sq, around);
}

LSDCD_FN bool face_meets(const FaceRecord &face, const Vec3 &c, Real around, Real cutoff,
                         Real &distance)
{
  const Vec3 d = c - face.anchor;
  distance = fabs(dot(face.normal, d));
  if (!(distance <= cutoff + around)) return false;
  const Real s[3] = {-dot(face.inward[0], d), -dot(face.inward[1], d) - face.height,
                     -dot(face.inward[2], d)};
  if (!(s[0] <= around && s[1] <= around && s[2] <= around)) return false;
  for (int k = 0; k < 3; k++) {
    const int j = (k + 1) % 3;
    const Real length_sq = 2 + 2 * dot(face.inward[k], face.inward[j]);
    if (is_past(s[k] + s[j], length_sq, around)) return false;
  }
  return true;
}

LSDCD_FN bool edge_meets(const EdgeRecord &edge, const Vec3 *edge_inward, const Vec3 &c,
                         Real around, Real cutoff, Real &distance)
{
  const Vec3 d = c - edge.anchor;
  const Real along = dot(edge.direction, d);
  if (!(along >= -around && along <= edge.length + around)) return false;
  const Vec3 radial = d - along * edge.direction;
  const Real limit = cutoff + around;
  if (!(norm_sq(radial) <= limit * limit)) return false;
  Vec3 sum = {0, 0, 0};
  for (std::uint32_t k = 0; k < edge.n_faces; k++) {
    const Vec3 inward = k < 2 ? edge.inward[k] : edge_inward[edge.more + k - 2];
    if (!(dot(inward, d) <= around)) return false;
    sum += inward;
  }
  if (is_past(dot(sum, d), norm_sq(sum), around)) return false;
  distance = norm(radial);
  return true;
}

LSDCD_FN bool vertex_meets(const VertexRecord &vertex, const Vec3 *direction, const Vec3 &c,
                           Real around, Real cutoff, Real &distance)
{
  const Vec3 d = c - vertex.position;
  const Real limit = cutoff + around;
  if (!(norm_sq(d) <= limit * limit)) return false;
  Vec3 sum = {0, 0, 0};
  for (std::uint32_t k = vertex.first; k < vertex.first + vertex.count; k++) {
    if (!(dot(direction[k], d) <= around)) return false;
    sum += direction[k];
  }
  if (is_past(dot(sum, d), norm_sq(sum), around)) return false;
  distance = norm(d);
  return true;
}

LSDCD_FN bool feature_meets(const MeshFeaturesView &wall, FeatureCode feature, const Vec3 &c,
                            Real around, Real cutoff, Real &distance)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      return face_meets(wall.faces[i], c, around, cutoff, distance);
    case FeatureKind::edge:
      return edge_meets(wall.edges[i], wall.edge_inward, c, around, cutoff, distance);
    default:
      return vertex_meets(wall.vertices[i], wall.vertex_direction, c, around, cutoff, distance);
  }
}

}    // namespace lsdcd
