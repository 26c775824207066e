// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The records of a mesh whose vertices move, made again from where they are: one source for the CPU and for devices,
// by the formulas of make_features() in Real where that keeps the digits of a normal. A face or edge that has only been
// shifted keeps its record to the last bit.
//
// In this order, each for all its items: move_face(), move_edge(), move_vertex(), put_parts(). They are for all threads of a
// warp together, which write records side by side: each has an item of its own, behind that of the thread before, or none where
// it is not `mine`.
#pragma once

#include "backend/atomic.h"
#include "backend/warp.h"
#include "geometry/wall_records.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

struct WeldedMesh;

// The arrays of a WeldedMesh that say what is beside what: three numbers a face, two an edge.
struct MeshTopologyView {
  const int *faces, *face_edges, *edges, *edge_first, *edge_face, *vertex_first, *vertex_edge;
  std::uint32_t n_faces, n_edges, n_vertices;
};
MeshTopologyView topology_of(const WeldedMesh &mesh);

// Records to be written, as those of MeshFeaturesView, and for each edge and vertex whether it can hold a contact now. Where
// that has changed, n_parts becomes the number of faces: then their parts are to be put.
struct MovingRecords {
  FaceRecord *faces;
  EdgeRecord *edges;
  VertexRecord *vertices;
  Vec3 *edge_inward, *vertex_direction;
  FaceParts *face_parts;
  Vec3 *edge_out, *vertex_out;    // null: without sides
  char *edge_acts, *vertex_acts;
  std::uint32_t *n_parts;
};

struct MovedMesh {
  MeshTopologyView mesh;
  MovingRecords to;
  const Vec3 *at, *before;    // places of vertices, now and when the records were made last
  Real far;                   // the largest coordinate, without its sign
};

// Notes whether an edge or vertex can hold a contact.
LSDCD_FN void put_acts(const MovedMesh &m, char &to, bool acts)
{
  if (to == static_cast<char>(acts)) return;
  to = static_cast<char>(acts);
  put_same(m.to.n_parts, m.mesh.n_faces);
}

// If two faces lie in one plane, the region of the edge between them is no wider than this
// angle. The grid's tolerance is four times wider.
constexpr Real kFlatFold = 1e-13;

LSDCD_FN bool is_flat(const EdgeRecord &e)
{
  if (e.n_faces != 2) return false;
  const Vec3 fold = e.inward[0] + e.inward[1];
  // The x of most edges tells alone; the factor covers rounding.
  return fabs(fold.x) <= 2 * kFlatFold && norm(fold) <= kFlatFold;
}

// A vertex inside a straight fold is covered by the two edges along it.
LSDCD_FN bool is_straight(const Vec3 *direction, int n)
{
  constexpr int kTooMany = 32;    // keeping a vertex is always right, only slower
  if (n > kTooMany) return false;
  for (int i = 0; i < n; i++)
    for (int j = i + 1; j < n; j++)
      // Most pairs differ by their x alone; the factor covers rounding.
      if (fabs(direction[i].x + direction[j].x) <= 2 * kFlatFold &&
          dot(direction[i], direction[j]) < 0 && norm(direction[i] + direction[j]) <= kFlatFold)
        return true;
  return false;
}

// Which of a face's three edges is edge i. Without a branch, which would be a guess.
LSDCD_FN int side_of(const MeshTopologyView &mesh, int face, std::uint32_t i)
{
  const int *edge = mesh.face_edges + 3 * face, is = static_cast<int>(i);
  return static_cast<int>(edge[1] == is) + 2 * static_cast<int>(edge[2] == is);
}

// Puts the inward normals of the faces of edge i, and zeros in place of those that it has not; `others` gets those of the faces
// past the second.
LSDCD_FN void put_inward(const MeshTopologyView &mesh, const FaceRecord *faces, std::uint32_t i,
                         EdgeRecord &e, Vec3 *others)
{
  const int first = mesh.edge_first[i], n = mesh.edge_first[i + 1] - first;
  for (int k = 0; k < n; k++) {
    const int face = mesh.edge_face[first + k];
    (k < 2 ? e.inward[k] : others[k - 2]) = faces[face].inward[side_of(mesh, face, i)];
  }
  for (int k = n; k < 2; k++) e.inward[k] = {0, 0, 0};
  e.n_faces = static_cast<std::uint32_t>(n);
}

LSDCD_FN Vec3 outward_of_edge(const MeshTopologyView &mesh, const FaceRecord *faces,
                              std::uint32_t i)
{
  Vec3 outward = {0, 0, 0};
  for (int k = mesh.edge_first[i]; k < mesh.edge_first[i + 1]; k++)
    outward += faces[mesh.edge_face[k]].normal;
  return outward;
}

LSDCD_FN std::uint32_t n_edges_at(const MeshTopologyView &mesh, std::uint32_t vertex)
{
  return static_cast<std::uint32_t>(mesh.vertex_first[vertex + 1] - mesh.vertex_first[vertex]);
}

// Returns the unit direction of an edge at vertex i, away from it.
LSDCD_FN Vec3 direction_at(const MeshTopologyView &mesh, const EdgeRecord *edges, int edge,
                           std::uint32_t i)
{
  // Without a branch, which would be a guess.
  const int begins = static_cast<int>(mesh.edges[2 * edge] == static_cast<int>(i));
  return Real(2 * begins - 1) * edges[edge].direction;
}

// The unit directions of the edges at vertex i, away from it.
LSDCD_FN void put_directions(const MeshTopologyView &mesh, const EdgeRecord *edges, std::uint32_t i,
                             Vec3 *to)
{
  for (int k = mesh.vertex_first[i]; k < mesh.vertex_first[i + 1]; k++)
    *to++ = direction_at(mesh, edges, mesh.vertex_edge[k], i);
}

// Do other features cover vertex i? A vertex inside a plane is covered by its faces.
LSDCD_FN bool is_covered(const MeshTopologyView &mesh, const EdgeRecord *edges, std::uint32_t i,
                         const Vec3 *direction)
{
  const std::uint32_t n = n_edges_at(mesh, i);
  bool inside_plane = n > 0;
  for (int k = mesh.vertex_first[i]; k < mesh.vertex_first[i + 1] && inside_plane; k++)
    inside_plane = is_flat(edges[mesh.vertex_edge[k]]);
  return inside_plane || is_straight(direction, static_cast<int>(n));
}

// Angle between two edges of a face at their common corner, in (0, pi).
LSDCD_FN Real corner_angle(const Vec3 &at, const Vec3 &b, const Vec3 &c)
{
  return atan2(norm(cross(b - at, c - at)), dot(b - at, c - at));
}

// Returns the sum of the normals of the faces around a vertex, weighted by their angles there. Of the two edges of a face
// at a vertex one begins there by the winding.
LSDCD_FN Vec3 outward_of_vertex(const MeshTopologyView &mesh, const Vec3 *at,
                                const FaceRecord *faces, std::uint32_t vertex)
{
  const int i = static_cast<int>(vertex);
  Vec3 outward = {0, 0, 0};
  for (int k = mesh.vertex_first[i]; k < mesh.vertex_first[i + 1]; k++) {
    const int edge = mesh.vertex_edge[k];
    for (int m = mesh.edge_first[edge]; m < mesh.edge_first[edge + 1]; m++) {
      const int face = mesh.edge_face[m], *corner = mesh.faces + 3 * face;
      int side = 0;
      while (mesh.face_edges[3 * face + side] != edge) side++;
      if (corner[side] != i) continue;
      const Real angle =
          corner_angle(at[i], at[corner[(side + 1) % 3]], at[corner[(side + 2) % 3]]);
      outward += angle * faces[face].normal;
    }
  }
  return outward;
}

// The edges and vertices of a face that can hold a contact, by a flag for each edge and vertex.
template <class Flags>
LSDCD_FN FaceParts parts_of(const MeshTopologyView &mesh, std::uint32_t face,
                            const Flags &edge_acts, const Flags &vertex_acts)
{
  FaceParts parts;
  for (int k = 0; k < 3; k++) {
    const auto edge = static_cast<std::uint32_t>(mesh.face_edges[3 * face + k]),
               vertex = static_cast<std::uint32_t>(mesh.faces[3 * face + k]);
    parts.part[k] = edge_acts[edge] ? feature_code(FeatureKind::edge, edge) : kNoFeature;
    parts.part[3 + k] =
        vertex_acts[vertex] ? feature_code(FeatureKind::vertex, vertex) : kNoFeature;
  }
  return parts;
}

// A face that is far from thin keeps its digits in Real. Its sides are at most longest, and twice its area at least
// kThick longest^2: the rounding of the normal is below 4 kRoundoff/kThick, 2e-14, which is a fifth of kFlatFold.
constexpr Real kThick = 0.05;

// Finds the record of a face that moves, by the formulas of make_face_record() in Real. False: it is too thin, or its
// squares may leave the range. `far`: no coordinate is larger.
LSDCD_FN bool put_thick_face(const Vec3 &a, const Vec3 &b, const Vec3 &c, Real far, FaceRecord &f)
{
  const Vec3 edge[3] = {b - a, c - b, a - c}, area = cross(edge[0], edge[1]);
  const Real sq[3] = {norm_sq(edge[0]), norm_sq(edge[1]), norm_sq(edge[2])},
             longer_sq = sq[1] < sq[2] ? sq[2] : sq[1],
             longest_sq = sq[0] < longer_sq ? longer_sq : sq[0], area_sq = norm_sq(area);
  constexpr Real kTiny = 1e-200, kHuge = 1e200;
  // It has an area, too, as has_area() asks for: the second test is that its height is above 8 kRoundoff far.
  if (!(area_sq >= kThick * kThick * (longest_sq * longest_sq) &&
        area_sq >= 64 * kRoundoff * kRoundoff * (far * far) * longest_sq && area_sq > kTiny &&
        area_sq < kHuge))
    return false;
  f.anchor = a;
  f.normal = (1 / sqrt(area_sq)) * area;
  for (int k = 0; k < 3; k++) f.inward[k] = (1 / sqrt(sq[k])) * cross(f.normal, edge[k]);
  f.height = -dot(f.inward[1], edge[0]);
  return true;
}

// Are two vertices as far apart as before?
LSDCD_FN bool keeps(const MovedMesh &m, int from, int to)
{
  return m.at[to] - m.at[from] == m.before[to] - m.before[from];
}

// False: the face is too thin for Real, its record has to be made by make_face_record().
template <unsigned kSize>
LSDCD_FN bool move_face(const Warp<kSize> &, bool mine, const MovedMesh &m, std::uint32_t f)
{
  RowOf<kSize, FaceRecord> face(m.to.faces + f);
  bool is_made = true;
  std::uint32_t words = 0;
  if (mine) {
    const int *c = m.mesh.faces + 3 * std::size_t(f);
    if (keeps(m, c[0], c[1]) && keeps(m, c[0], c[2])) {
      (*face).anchor = m.at[c[0]];
      words = words_of(0, sizeof(Vec3));
    } else {
      is_made = put_thick_face(m.at[c[0]], m.at[c[1]], m.at[c[2]], m.far, *face);
      if (is_made) words = words_of(0, sizeof(FaceRecord));
    }
  }
  face.put(words);
  return is_made;
}

// Makes direction and length of an edge. False: its squares leave the range of Real.
LSDCD_FN bool put_segment(const Vec3 &from, const Vec3 &to, EdgeRecord &e)
{
  const Vec3 d = to - from;
  const Real sq = norm_sq(d);
  if (!(sq > 1e-200 && sq < 1e200)) return false;
  e.length = sqrt(sq);
  e.direction = (1 / e.length) * d;
  return true;
}

// False: direction and length have to be those of make_segment().
template <unsigned kSize>
LSDCD_FN bool move_edge(const Warp<kSize> &, bool mine, const MovedMesh &m, std::uint32_t i)
{
  const std::uint32_t all = words_of(0, sizeof(EdgeRecord)),
                      of_segment =
                          words_of(offsetof(EdgeRecord, direction), offsetof(EdgeRecord, inward));
  RowOf<kSize, EdgeRecord> edge(m.to.edges + i);
  bool is_made = true;
  std::uint32_t words = 0;
  if (mine) {
    EdgeRecord &e = *edge;
    const int from = m.mesh.edges[2 * std::size_t(i)], to = m.mesh.edges[2 * std::size_t(i) + 1];
    const bool is_kept = keeps(m, from, to);
    e.anchor = m.at[from];
    e.more = m.to.edges[i].more;
    is_made = is_kept || put_segment(e.anchor, m.at[to], e);
    put_inward(m.mesh, m.to.faces, i, e, m.to.edge_inward + e.more);
    if (m.to.edge_out) m.to.edge_out[i] = outward_of_edge(m.mesh, m.to.faces, i);
    put_acts(m, m.to.edge_acts[i], !is_flat(e));
    words = is_kept || !is_made ? all & ~of_segment : all;
  }
  edge.put(words);
  return is_made;
}

template <unsigned kSize>
LSDCD_FN void move_vertex(const Warp<kSize> &warp, bool mine, const MovedMesh &m, std::uint32_t i)
{
  const std::uint32_t begins = warp.of(i, 0);
  const auto first_of = [&](std::uint32_t vertex) {
    return static_cast<std::uint32_t>(m.mesh.vertex_first[vertex]);
  };
  // One that is not there has no edges, behind all.
  const std::uint32_t first = first_of(mine ? i : m.mesh.n_vertices),
                      end = mine ? first_of(i + 1) : first;
  for_each_side_by_side(warp, first, end, [&](unsigned rank, std::uint32_t k) {
    m.to.vertex_direction[k] =
        direction_at(m.mesh, m.to.edges, m.mesh.vertex_edge[k], begins + rank);
  });
  warp.wait();    // directions are others'
  RowOf<kSize, VertexRecord> vertex(m.to.vertices + i);
  if (mine) {
    *vertex = {m.at[i], first, end - first};
    put_acts(m, m.to.vertex_acts[i],
             !is_covered(m.mesh, m.to.edges, i, m.to.vertex_direction + first));
    if (m.to.vertex_out) m.to.vertex_out[i] = outward_of_vertex(m.mesh, m.at, m.to.faces, i);
  }
  vertex.put(mine ? words_of(0, sizeof(VertexRecord)) : 0);
}

template <unsigned kSize>
LSDCD_FN void put_parts(const Warp<kSize> &, bool mine, const MovedMesh &m, std::uint32_t f)
{
  RowOf<kSize, FaceParts> parts(m.to.face_parts + f);
  if (mine) *parts = parts_of(m.mesh, f, m.to.edge_acts, m.to.vertex_acts);
  parts.put(mine ? words_of(0, sizeof(FaceParts)) : 0);
}

}    // namespace lsdcd
