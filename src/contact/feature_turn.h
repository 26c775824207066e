// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How a spring turns with its feature where the nodes of the mesh move.
#pragma once

#include "contact/history.h"
#include "contact/spring.h"
#include "mesh/moving_records.h"

namespace lsdcd {

// The vectors that a spring keeps beside its shear displacement, at most.
constexpr int kMostVectors = 2;

// A mesh whose nodes have gone from `from` to `to`, and the records of its faces there.
struct TurningMesh {
  MeshTopologyView mesh;
  const FaceRecord *faces;
  const Vec3 *from, *to;
};

// The rotation of a face: its normal by the smallest turn of its plane, and in the plane the turn that fits best
// (the polar decomposition of the plane map).
struct FaceTurn {
  Vec3 from[3], to[3];    // orthonormal frames
  bool is_none;

  LSDCD_FN FaceTurn(const Vec3 &a0, const Vec3 &b0, const Vec3 &c0, const Vec3 &a1, const Vec3 &b1,
                    const Vec3 &c1)
  {
    const Vec3 e0 = b0 - a0, f0 = c0 - a0, e1 = b1 - a1, f1 = c1 - a1;
    is_none = e0 == e1 && f0 == f1;
    if (is_none) return;
    const Vec3 n0 = cross(e0, f0), n1 = cross(e1, f1);
    const Real length0 = norm(e0), length1 = norm(e1), area0 = norm(n0), area1 = norm(n1),
               of_length0 = 1 / length0, of_area0 = 1 / area0;
    from[0] = of_length0 * e0;
    from[2] = of_area0 * n0;
    from[1] = cross(from[2], from[0]);
    const Vec3 first = (1 / length1) * e1;
    to[2] = (1 / area1) * n1;
    const Vec3 second = cross(to[2], first);
    // The plane map in these frames is upper triangular, (p q; 0 r), with p = |e1|/|e0| and p r the ratio of areas. It
    // turns by the angle of (p + r, -q), here times p.
    const Real p = length1 * of_length0, c = p * p + area1 * of_area0,
               s = p * (p * dot(f0, from[0]) - dot(f1, first)) * (length0 * of_area0),
               over = 1 / sqrt(c * c + s * s), cosine = over * c, sine = over * s;
    to[0] = cosine * first + sine * second;
    to[1] = cosine * second - sine * first;
  }
  LSDCD_FN Vec3 of(const Vec3 &a) const
  {
    if (is_none) return a;
    return dot(from[0], a) * to[0] + dot(from[1], a) * to[1] + dot(from[2], a) * to[2];
  }
};

LSDCD_FN FaceTurn turn_of_face(const TurningMesh &m, int face)
{
  const int *c = m.mesh.faces + 3 * std::size_t(face);
  return {m.from[c[0]], m.from[c[1]], m.from[c[2]], m.to[c[0]], m.to[c[1]], m.to[c[2]]};
}

// Sums of turned vectors over the faces of a feature.
struct TurnedSums {
  Vec3 sum[2 + kMostVectors];
  int n_faces;
  bool any;

  LSDCD_FN void add(const FaceTurn &turn, const Vec3 *vectors, int n)
  {
    n_faces++;
    any |= !turn.is_none;
    for (int k = 0; k < n; k++) sum[k] += turn.of(vectors[k]);
  }
};

LSDCD_FN void add_faces_of_edge(const TurningMesh &m, int edge, const Vec3 *vectors, int n,
                                TurnedSums &sums)
{
  for (int k = m.mesh.edge_first[edge]; k < m.mesh.edge_first[edge + 1]; k++)
    sums.add(turn_of_face(m, m.mesh.edge_face[k]), vectors, n);
}

LSDCD_FN Vec3 direction_of_edge(const TurningMesh &m, int edge, const Vec3 *at)
{
  const Vec3 along = at[m.mesh.edges[2 * edge + 1]] - at[m.mesh.edges[2 * edge]];
  return (1 / norm(along)) * along;
}

// Turns a spring and the n_vectors vectors beside it with its feature. On a face it keeps the face's normal, to the last
// bit. An edge and a vertex turn by the mean of the rotations of their faces, keeping lengths: the faces around a vertex
// count twice, as each is beside two of its edges. An edge without a face turns by the smallest turn of its direction.
LSDCD_FN void turn_with_feature(const TurningMesh &m, Spring &spring, Vec3 *beside, int n_vectors)
{
  const int i = static_cast<int>(feature_index(spring.feature)), n = 2 + n_vectors;
  const FeatureKind kind = feature_kind(spring.feature);
  Vec3 vectors[2 + kMostVectors] = {spring.normal, spring.shear};
  for (int k = 0; k < n_vectors; k++) vectors[2 + k] = beside[k];
  if (kind == FeatureKind::face) {
    const FaceTurn turn = turn_of_face(m, i);
    for (int k = 0; k < n; k++) vectors[k] = turn.of(vectors[k]);
    const Vec3 &now = m.faces[i].normal;
    vectors[0] = dot(vectors[0], now) < 0 ? -now : now;
  } else {
    TurnedSums sums = {};
    if (kind == FeatureKind::edge)
      add_faces_of_edge(m, i, vectors, n, sums);
    else
      for (int k = m.mesh.vertex_first[i]; k < m.mesh.vertex_first[i + 1]; k++)
        add_faces_of_edge(m, m.mesh.vertex_edge[k], vectors, n, sums);
    if (sums.n_faces == 0 && kind == FeatureKind::edge) {
      const Vec3 was = direction_of_edge(m, i, m.from), now = direction_of_edge(m, i, m.to);
      for (int k = 0; k < n; k++) vectors[k] = transport(vectors[k], was, now);
    }
    for (int k = 0; k < n && sums.any; k++) {
      const Real length = norm(sums.sum[k]);
      if (sums.n_faces == 1)
        vectors[k] = sums.sum[k];
      else if (length > 0)
        vectors[k] = (norm(vectors[k]) / length) * sums.sum[k];
    }
  }
  spring.normal = vectors[0];
  spring.shear = vectors[1];
  for (int k = 0; k < n_vectors; k++) beside[k] = vectors[2 + k];
}

}    // namespace lsdcd
