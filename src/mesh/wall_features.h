// Faces, edges and vertices of a wall as records that a contact query reads.
#pragma once

#include "base/vec3.h"
#include "mesh/feature_code.h"
#include "mesh/wall_mesh.h"

#include <cstdint>
#include <vector>

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

// An edge as a segment and the in-plane inward normals of its faces: a foot
// point on it is a local minimum of distance if no face lets the distance fall.
struct EdgeRecord {
  Vec3 anchor;       // its first vertex
  Vec3 direction;    // unit, towards the second
  Real length;
  Vec3 inward[2];    // of the first two faces
  std::uint32_t n_faces;
  std::uint32_t more;    // faces past the second: edge_inward[more ...]
};

// A vertex with the unit directions of its edges: vertex_direction[first ...].
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

// The edges and vertices of a face that can hold a contact of their own, kNoFeature in
// place of the others.
struct FaceParts {
  FeatureCode part[6];
};

struct WallFeaturesView {
  const FaceRecord *faces;
  const EdgeRecord *edges;
  const VertexRecord *vertices;
  const Vec3 *edge_inward;
  const Vec3 *vertex_direction;
  const FaceVertices *face_vertex;
  const EdgeVertices *edge_vertex;
  const Vec3 *edge_out;    // angle-weighted pseudonormals; only read where a side is set
  const Vec3 *vertex_out;
  const FaceParts *face_parts;    // only read where lists hold pieces
  // As in PeriodicImages; null and 0 where there are none.
  const std::int32_t *same_vertex, *face_of, *edge_of, *vertex_of;
  std::uint32_t n_faces, n_edges, n_vertices;
};

// The part of the mesh itself that a feature is, or is an image of.
LSDCD_FN FeatureCode own_feature(const WallFeaturesView &wall, FeatureCode feature)
{
  if (!wall.same_vertex) return feature;
  const FeatureKind kind = feature_kind(feature);
  const std::uint32_t i = feature_index(feature);
  const bool face = kind == FeatureKind::face, edge = kind == FeatureKind::edge;
  const std::uint32_t n = face ? wall.n_faces : (edge ? wall.n_edges : wall.n_vertices);
  if (i < n) return feature;
  const std::int32_t *of = face ? wall.face_of : (edge ? wall.edge_of : wall.vertex_of);
  return feature_code(kind, static_cast<std::uint32_t>(of[i - n]));
}

// Records of every face and of the edges and vertices that can hold a contact of
// their own. A flat edge cannot: its faces, closed by a tolerance, cover it.
struct WallFeatures {
  std::vector<FaceRecord> faces;
  std::vector<EdgeRecord> edges;
  std::vector<VertexRecord> vertices;
  std::vector<Vec3> edge_inward;
  std::vector<Vec3> vertex_direction;
  std::vector<FaceVertices> face_vertex;
  std::vector<EdgeVertices> edge_vertex;
  std::vector<Vec3> edge_out, vertex_out;
  std::vector<FaceParts> face_parts;
  PeriodicImages images;
  std::vector<FeatureCode> contact_features;    // what a grid has to sort into cells
  // The wall in pieces: every face stands for its edges and vertices as well; edges
  // and vertices without a face stand for themselves.
  std::vector<FeatureCode> pieces;

  WallFeaturesView view() const
  {
    return {faces.data(),
            edges.data(),
            vertices.data(),
            edge_inward.data(),
            vertex_direction.data(),
            face_vertex.data(),
            edge_vertex.data(),
            edge_out.data(),
            vertex_out.data(),
            face_parts.data(),
            images.any() ? images.same_vertex.data() : nullptr,
            images.face_of.data(),
            images.edge_of.data(),
            images.vertex_of.data(),
            static_cast<std::uint32_t>(images.n_faces),
            static_cast<std::uint32_t>(images.n_edges),
            static_cast<std::uint32_t>(images.n_vertices)};
  }
};

// `with_sides` adds the pseudonormals that tell inside from outside, `with_pieces` the
// pieces and the parts of faces.
WallFeatures make_features(const WallMesh &mesh, bool with_sides, bool with_pieces = false);

}    // namespace lsdcd
