// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The lists of a mesh whose nodes move, built by a backend and brought to the host.
#pragma once

#include "grid/build/moving_grid.h"
#include "mesh/mesh_features.h"

#include <vector>

namespace lsdcd {

struct NodeLists {
  GridView scalars;    // its pointers are of no use
  std::vector<std::int32_t> brick_of;
  std::vector<Brick> bricks;
  std::vector<Cell> cells;
  std::vector<CellEntry> entries;
};

template <class B>
NodeLists node_lists_by(B b, const WeldedMesh &mesh, const MovingGridSettings &settings)
{
  const MeshFeatures features = make_moving_features(mesh, false);
  const auto vertices = from_cpu(b, features.vertices);
  const auto faces = from_cpu(b, features.faces);
  const auto face_vertex = from_cpu(b, features.face_vertex);
  const auto edge_vertex = from_cpu(b, features.edge_vertex);
  const auto code = from_cpu(b, features.primitives);
  MeshFeaturesView records = {};
  records.vertices = vertices.data();
  records.faces = faces.data();
  records.face_vertex = face_vertex.data();
  records.edge_vertex = edge_vertex.data();
  MovingGrid<B> grid;
  grid.build(b, records, {code.data(), code.size()}, settings);
  const BuiltLists<B> &built = grid.lists();
  NodeLists lists;
  lists.scalars = grid.view(MeshFeaturesView());
  lists.brick_of = to_cpu(b, built.brick_of, built.brick_of.size());
  lists.bricks = to_cpu(b, built.bricks, built.n_bricks);
  lists.cells = to_cpu(b, built.cells, built.n_cells);
  lists.entries = to_cpu(b, built.entries, built.n_entries);
  return lists;
}

// In a build with CUDA.
NodeLists node_lists_on_cuda(const WeldedMesh &mesh, const MovingGridSettings &settings);

}    // namespace lsdcd
