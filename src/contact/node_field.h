// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The shares of a feature's nodes in one of its points, and the velocity there, for a mesh whose nodes move.
#pragma once

#include "contact/history.h"

namespace lsdcd {

// A value for each vertex of a mesh, or null. The spin is the mean angular velocity of the faces around a vertex.
struct NodeField {
  const Vec3 *velocity = nullptr;    // length/time; null: the nodes of this mesh do not move
  const Vec3 *spin = nullptr;        // 1/time
  Real going = 0;                    // length; how far nodes move before the next candidate search
};

// The nodes of a feature and their shares in a point of it: the barycentric coordinates of the point. They add up
// to 1.
struct NodeShares {
  int n;
  std::int32_t node[3];
  Real share[3];
};

LSDCD_FN NodeShares node_shares(const MeshFeaturesView &wall, FeatureCode feature, const Vec3 &at)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face: {
      // The share is the distance from an edge over the distance of the opposite corner from that edge.
      const FaceRecord &face = wall.faces[i];
      const FaceVertices &corner = wall.face_vertex[i];
      const Vec3 d = at - face.anchor;
      const Real zero = (dot(face.inward[1], d) + face.height) / face.height,
                 one = dot(face.inward[2], d) /
                       dot(face.inward[2], wall.vertices[corner.v[1]].position - face.anchor);
      return {3, {corner.v[0], corner.v[1], corner.v[2]}, {zero, one, 1 - zero - one}};
    }
    case FeatureKind::edge: {
      const EdgeRecord &edge = wall.edges[i];
      const EdgeVertices &end = wall.edge_vertex[i];
      const Real one = dot(edge.direction, at - edge.anchor) / edge.length;
      return {2, {end.v[0], end.v[1], 0}, {1 - one, one, 0}};
    }
    default:
      return {1, {static_cast<std::int32_t>(i), 0, 0}, {1, 0, 0}};
  }
}

// Returns the nodes of a feature with shares that an earlier call of node_shares() has returned for it.
LSDCD_FN NodeShares shares_again(const MeshFeaturesView &wall, FeatureCode feature,
                                 const Real (&share)[3])
{
  NodeShares at = {0, {0, 0, 0}, {share[0], share[1], share[2]}};
  at.n = feature_vertices(wall, feature, at.node);
  return at;
}

// Returns the value of a field at the point. If all nodes have the same value, it is exactly that.
LSDCD_FN Vec3 field_at(const NodeShares &at, const Vec3 *field)
{
  const Vec3 first = field[at.node[0]];
  Vec3 value = first;
  for (int k = 1; k < 3; k++)    // a fixed number, so that a GPU has the shares in registers
    if (k < at.n) value += at.share[k] * (field[at.node[k]] - first);
  return value;
}

}    // namespace lsdcd
