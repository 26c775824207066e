// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Faces, edges and vertices of a wall as records that a contact query reads.
#pragma once

#include "base/vec3.h"
#include "geometry/feature_code.h"

#include <cstdint>

namespace lsdcd {

// A face as its plane and three in-plane half-spaces; no division by an area.
// inward[k] is the unit in-plane normal of edge k that points into the face.
// With d = q - anchor, the signed distances from the edges are dot(inward[0], d),
// dot(inward[1], d) + height and dot(inward[2], d).
struct FaceRecord {
  Vec3 anchor;    // corner 0
  Vec3 normal;    // unit, by the winding
  Vec3 inward[3];
  Real height;    // distance of corner 0 from edge 1
};

// An edge as a segment and the in-plane inward normals of its faces: a closest
// point on it is a local minimum of distance if no face lets the distance fall.
struct EdgeRecord {
  Vec3 anchor;       // its first vertex
  Vec3 direction;    // unit, towards the second
  Real length;
  Vec3 inward[2];    // of the first two faces
  std::uint32_t n_faces;
  std::uint32_t more;    // faces past the second: edge_inward[more ...]
};

// A vertex and its edges' unit directions, vertex_direction[first ...]; NaN: it holds no contact.
struct VertexRecord {
  Vec3 position;
  std::uint32_t first, count;
};

struct FaceVertices {
  std::int32_t v[3];
};
struct EdgeVertices {
  std::int32_t v[2];
};

// The edges and vertices of a face that can hold a contact of their own, and kNoFeature in
// the positions of the others.
struct FaceParts {
  FeatureCode part[6];
};

// As PeriodicImages of the mesh; null and 0 if there are none.
struct PeriodicImagesView {
  const std::int32_t *same_vertex, *face_of, *edge_of, *vertex_of;
  std::uint32_t n_faces, n_edges, n_vertices;
};

struct MeshFeaturesView {
  const FaceRecord *faces;
  const EdgeRecord *edges;
  const VertexRecord *vertices;
  const Vec3 *edge_inward;
  const Vec3 *vertex_direction;
  const FaceVertices *face_vertex;
  const EdgeVertices *edge_vertex;
  const Vec3 *edge_out;    // angle-weighted pseudonormals; only read where a side is set
  const Vec3 *vertex_out;
  const FaceParts *face_parts;    // only read where lists hold primitives
  PeriodicImagesView images;

  // Calls visit() with each array of a view or of MeshFeatures.
  template <class Wall, class Visit>
  static constexpr void each_array(Wall &wall, const Visit &visit)
  {
    visit(wall.faces);
    visit(wall.edges);
    visit(wall.vertices);
    visit(wall.edge_inward);
    visit(wall.vertex_direction);
    visit(wall.face_vertex);
    visit(wall.edge_vertex);
    visit(wall.edge_out);
    visit(wall.vertex_out);
    visit(wall.face_parts);
    visit(wall.images.same_vertex);
    visit(wall.images.face_of);
    visit(wall.images.edge_of);
    visit(wall.images.vertex_of);
  }
};

// The feature of the mesh that this feature is, or is an image of.
LSDCD_FN FeatureCode own_feature(const MeshFeaturesView &wall, FeatureCode feature)
{
  const PeriodicImagesView &images = wall.images;
  if (!images.same_vertex) return feature;
  const FeatureKind kind = feature_kind(feature);
  const std::uint32_t i = feature_index(feature);
  const bool face = kind == FeatureKind::face, edge = kind == FeatureKind::edge;
  const std::uint32_t n = face ? images.n_faces : (edge ? images.n_edges : images.n_vertices);
  if (i < n) return feature;
  const std::int32_t *of = face ? images.face_of : (edge ? images.edge_of : images.vertex_of);
  return feature_code(kind, static_cast<std::uint32_t>(of[i - n]));
}

// The record of one feature.
union FeatureRecord {
  FaceRecord face;
  EdgeRecord edge;
  VertexRecord vertex;
};

inline FeatureRecord record_of(const MeshFeaturesView &wall, FeatureCode feature)
{
  const std::uint32_t i = feature_index(feature);
  FeatureRecord record;
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      record.face = wall.faces[i];
      break;
    case FeatureKind::edge:
      record.edge = wall.edges[i];
      break;
    default:
      record.vertex = wall.vertices[i];
  }
  return record;
}

// On a host: prefetches the record of a feature.
inline void prefetch(const MeshFeaturesView &wall, FeatureCode feature)
{
  const std::uint32_t i = feature_index(feature);
  const auto fetch = [](const auto *record) {
    const char *at = reinterpret_cast<const char *>(record);
    __builtin_prefetch(at);
    __builtin_prefetch(at + sizeof *record - 1);
    asm volatile("");    // else gcc drops calls of a function that only prefetches
  };
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      return fetch(wall.faces + i);
    case FeatureKind::edge:
      return fetch(wall.edges + i);
    default:
      return fetch(wall.vertices + i);
  }
}

}    // namespace lsdcd
