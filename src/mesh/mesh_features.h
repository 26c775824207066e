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
  // Of a mesh that moves: face_parts name all edges and vertices. False where others than update_features() wrote them.
  bool all_parts_act = false;

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

// Updates the records of make_moving_features() for vertices that have moved, and that were at `before` at the last
// call. A face or edge that has only been shifted keeps its record to the last bit; the others get theirs by the
// formulas of make_features() in Real, where that keeps the digits of a normal. Throws InputError where a face has no
// area.
void update_features(const WeldedMesh &mesh, const std::vector<Vec3> &before, bool with_sides,
                     MeshFeatures &features);

// Returns the parts of it, for an engine that has records of its own (mesh/moving_records.h).

// Returns the records of a view to be written, and flags of its edges and vertices.
MovingRecords moving_records(const MeshFeaturesView &of, char *edge_acts, char *vertex_acts);
// The record of a face that is too thin for Real. Throws InputError where it has no area.
FaceRecord make_thin_face_record(const WeldedMesh &mesh, std::size_t face);
// Place, direction and length of an edge whose squares leave the range of Real.
void put_far_segment(const WeldedMesh &mesh, std::size_t edge, EdgeRecord &e);

}    // namespace lsdcd
