// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Copies of the wall's features in float, each in the frame of a brick, for searches in mixed and
// single precision. A feature has a copy in every brick that lists it.
#pragma once

#include "base/vec3.h"
#include "geometry/wall_records.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

using Vec3f = Vec3Of<float>;

// The origin is the centre of the brick. Planes and lines have their anchor next to it, so that
// coordinates are no larger than a brick even if faces and mesh are.

// Aligned so that a GPU loads a record in parts of 16 bytes.

// A plane by which heights are computed: normal . p + offset. Length.
struct alignas(16) BrickPlane {
  Vec3f normal;    // unit
  float offset;
};
struct BrickFace {
  BrickPlane plane;
  BrickPlane side[3];    // height >= 0 inside the face
};
struct alignas(16) BrickEdge {
  Vec3f anchor;    // point of the edge's line nearest to the origin
  Vec3f direction;
  float lo, hi;    // where the edge begins and ends, from the anchor
  Vec3f inward[2];
  std::uint32_t n_faces, more;    // as in EdgeRecord
};
struct BrickVertex {
  Vec3f position;
  std::uint32_t first, count;    // as in VertexRecord
};

// The copies of a grid. With these, a code in a list means a record: its kind, and its index in the
// array of that kind.
struct BrickRecordsView {
  const BrickFace *faces;
  const BrickEdge *edges;
  const BrickVertex *vertices;
  const std::uint32_t *face_of, *edge_of, *vertex_of;    // the feature of which it is a copy
  const FaceParts *face_parts;                           // in records; only with nearest lists
  const Vec3f *edge_inward, *vertex_direction;           // as in MeshFeaturesView

  // Calls visit() with each array of a view or of BrickRecords.
  template <class Records, class Visit>
  static constexpr void each_array(Records &records, const Visit &visit)
  {
    visit(records.faces);
    visit(records.edges);
    visit(records.vertices);
    visit(records.face_of);
    visit(records.edge_of);
    visit(records.vertex_of);
    visit(records.face_parts);
    visit(records.edge_inward);
    visit(records.vertex_direction);
  }
};

struct BrickRecords {
  std::vector<BrickFace> faces;
  std::vector<BrickEdge> edges;
  std::vector<BrickVertex> vertices;
  std::vector<std::uint32_t> face_of, edge_of, vertex_of;
  std::vector<FaceParts> face_parts;
  std::vector<Vec3f> edge_inward, vertex_direction;
};

struct TriangleGrid;

// Throws InputError if there are more records of a kind than codes can number.
void check_record_number(std::uint64_t n);

// Makes the records and rewrites the codes of all lists.
void add_brick_records(TriangleGrid &grid);

}    // namespace lsdcd
