// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The records of a wall, made from its mesh.
#pragma once

#include "geometry/wall_records.h"
#include "mesh/moving_records.h"
#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

// Records of every face and vertex, and of edges up to the last that can hold a contact of its own. A
// flat edge cannot: its faces, closed by a tolerance, cover it. The mesh numbers flat edges last.
struct MeshFeatures {
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
  // The primitives of the wall: the faces, each for its edges and vertices, too, and the
  // edges and vertices without a face.
  std::vector<FeatureCode> primitives;

  MeshFeaturesView view() const;
};

// Returns the record of a face with three corners that are not in a line.
FaceRecord make_face_record(const Vec3 &a, const Vec3 &b, const Vec3 &c);

// `with_sides` adds the pseudonormals that distinguish inside from outside, `with_primitives` the
// primitives and the parts of faces.
MeshFeatures make_features(const WeldedMesh &mesh, bool with_sides, bool with_primitives = false);

// Returns the records of a mesh whose vertices move: those of every edge and vertex, as any of them may hold a contact
// later. Which do now, face_parts says, and grids sort `primitives`.
MeshFeatures make_moving_features(const WeldedMesh &mesh, bool with_sides);

// Returns the records of a view to be written, with flags of its edges and vertices.
MovingRecords moving_records(const MeshFeaturesView &of, char *edge_acts, char *vertex_acts,
                             std::uint32_t *n_parts);
// Returns whether a face is so far from a line that it has a normal.
bool has_area(const Vec3 &a, const Vec3 &b, const Vec3 &c);
// Returns place, direction and length of an edge.
EdgeRecord make_segment(const Vec3 &a, const Vec3 &b);
[[noreturn]] void throw_without_area(const WeldedMesh &mesh, int face);

}    // namespace lsdcd
