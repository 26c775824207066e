// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Turns a spring with its feature when the nodes of the mesh move.
#pragma once

#include "contact/history.h"
#include "contact/spring.h"
#include "mesh/moving_records.h"

namespace lsdcd {

// The largest number of vectors that a spring keeps in addition to its shear displacement.
constexpr int kMostVectors = 2;

// A mesh whose nodes have moved from `from` to `to`, with the records of its faces at `to`.
struct TurningMesh {
  MeshTopologyView mesh;
  const FaceRecord *faces;
  const Vec3 *from, *to;
};

// The rotation of a face: the smallest rotation that takes its old plane to its new one, followed by the rotation in that plane
// that fits best (the polar decomposition of the plane map). `now`: the unit normal of the face after the turn.
//
// With the edges e0, f0 from one corner before and e1, f1 after, and the areas n = e x f, the plane map in the frames
// (e/|e|, n x e/(|n| |e|)) is upper triangular, (p q; 0 r), with p = |e1|/|e0| and p r = |n1|/|n0|. It turns by the angle of
// (p + r, -q), which is that of
//
//   c = p^2 + |n1|/|n0|,   s = (p^2 f0.e0 - f1.e1)/|n0|.
struct FaceTurn {
  Vec3 from[3], to[3];    // orthogonal frames: those of `from` have lengths that those of `to` undo
  bool is_none;

  LSDCD_FN FaceTurn(const Vec3 &a0, const Vec3 &b0, const Vec3 &c0, const Vec3 &a1, const Vec3 &b1,
                    const Vec3 &c1, const Vec3 &now)
  {
    const Vec3 e0 = b0 - a0, f0 = c0 - a0, e1 = b1 - a1, f1 = c1 - a1;
    is_none = e0 == e1 && f0 == f1;
    if (is_none) return;
    const Vec3 n0 = cross(e0, f0);
    const Real length0_sq = norm_sq(e0), length1_sq = norm_sq(e1), area1 = dot(cross(e1, f1), now),
               of_area0 = 1 / norm(n0), p_sq = length1_sq / length0_sq, c = p_sq + area1 * of_area0,
               s = of_area0 * (p_sq * dot(f0, e0) - dot(f1, e1)),
               over = 1 / sqrt((c * c + s * s) * (length0_sq * length1_sq)), cosine = over * c,
               sine = over * s;
    const Vec3 second = cross(now, e1);
    from[0] = e0;
    from[2] = of_area0 * n0;
    from[1] = cross(from[2], e0);
    to[0] = cosine * e1 + sine * second;
    to[1] = cosine * second - sine * e1;
    to[2] = now;
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
  return {m.from[c[0]], m.from[c[1]], m.from[c[2]],        m.to[c[0]],
          m.to[c[1]],   m.to[c[2]],   m.faces[face].normal};
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

// Prefetches, on a CPU, what is needed to turn a spring whose turn comes soon.
LSDCD_FN void prefetch_turn([[maybe_unused]] const TurningMesh &m,
                            [[maybe_unused]] const Spring &spring)
{
#if !LSDCD_ON_GPU()
  if (feature_kind(spring.feature) != FeatureKind::face) return;
  const std::size_t i = feature_index(spring.feature);
  __builtin_prefetch(m.mesh.faces + 3 * i);
  __builtin_prefetch(&m.faces[i].normal);
#endif
}

// Turns a spring, and the n_vectors vectors beside it, with the feature of the spring. On a face the spring's normal is the
// normal of the face, to the last bit. On an edge or a vertex the spring turns by the mean of the rotations of its faces, and
// lengths are kept. The faces around a vertex count twice, because each is beside two of its edges. An edge without a face turns
// by the smallest rotation of its line; if its ends have changed places, it has not turned.
LSDCD_FN void turn_with_feature(const TurningMesh &m, Spring &spring, Vec3 *beside, int n_vectors)
{
  const int i = static_cast<int>(feature_index(spring.feature)), n = 2 + n_vectors;
  const FeatureKind kind = feature_kind(spring.feature);
  if (kind == FeatureKind::face) {
    const FaceTurn turn = turn_of_face(m, i);
    const Vec3 &now = m.faces[i].normal;
    spring.normal = dot(turn.is_none ? now : turn.from[2], spring.normal) < 0 ? -now : now;
    spring.shear = turn.of(spring.shear);
    for (int k = 0; k < n_vectors; k++) beside[k] = turn.of(beside[k]);
    return;
  }
  Vec3 vectors[2 + kMostVectors] = {spring.normal, spring.shear};
  for (int k = 0; k < n_vectors; k++) vectors[2 + k] = beside[k];
  TurnedSums sums = {};
  if (kind == FeatureKind::edge)
    add_faces_of_edge(m, i, vectors, n, sums);
  else
    for (int k = m.mesh.vertex_first[i]; k < m.mesh.vertex_first[i + 1]; k++)
      add_faces_of_edge(m, m.mesh.vertex_edge[k], vectors, n, sums);
  if (sums.n_faces == 0 && kind == FeatureKind::edge) {
    const Vec3 was = direction_of_edge(m, i, m.from), now = direction_of_edge(m, i, m.to);
    for (int k = 0; k < n; k++)
      vectors[k] = transport(vectors[k], was, dot(was, now) < 0 ? -now : now);
  }
  for (int k = 0; k < n && sums.any; k++) {
    const Real length = norm(sums.sum[k]);
    if (sums.n_faces == 1)
      vectors[k] = sums.sum[k];
    else if (length > 0)
      vectors[k] = (norm(vectors[k]) / length) * sums.sum[k];
  }
  spring.normal = vectors[0];
  spring.shear = vectors[1];
  for (int k = 0; k < n_vectors; k++) beside[k] = vectors[2 + k];
}

}    // namespace lsdcd
