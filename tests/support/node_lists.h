// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The lists of a mesh whose nodes move, built by a backend and brought to the host.
#pragma once

#include "grid/build/node_grid.h"
#include "mesh/mesh_features.h"

#include <algorithm>
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
NodeLists node_lists_by(B b, const WeldedMesh &mesh, const NodeGridSettings &settings)
{
  const MeshFeatures features = make_moving_features(mesh, false);
  const MeshTopologyView topology = topology_of(mesh);
  const auto faces = from_cpu(
      b, std::vector<int>(topology.faces, topology.faces + 3 * std::size_t(topology.n_faces)));
  const auto edges = from_cpu(
      b, std::vector<int>(topology.edges, topology.edges + 2 * std::size_t(topology.n_edges)));
  const auto at = from_cpu(b, mesh.vertices);
  const auto code = from_cpu(b, features.primitives);
  const auto records = from_cpu(b, features.faces);
  NodeGrid<B> grid;
  grid.build(b, {code.data(), code.size(), faces.data(), edges.data(), at.data(), records.data()},
             settings);
  NodeLists lists;
  lists.scalars = grid.view(MeshFeaturesView());
  lists.brick_of = to_cpu(b, grid.brick_of(), grid.brick_of().size());
  lists.bricks = to_cpu(b, grid.bricks(), grid.bricks().size());
  const auto fetch = [&](const auto *from, auto &to, std::size_t n) {
    to.resize(n);
    b.copy_out(from, to.data(), n);
    b.wait();
  };
  std::size_t n_cells = 0, n_entries = 0;
  for (const Brick &brick : lists.bricks)
    for (const BrickLayer &layer : brick.layer) n_cells += count_bits(layer.mask);
  fetch(lists.scalars.lists.cells, lists.cells, n_cells);
  for (const Cell &c : lists.cells)
    if (c.count > 1) n_entries = std::max<std::size_t>(n_entries, c.first + c.count);
  fetch(lists.scalars.lists.entries, lists.entries, n_entries);
  return lists;
}

// In a build with CUDA.
NodeLists node_lists_on_cuda(const WeldedMesh &mesh, const NodeGridSettings &settings);

}    // namespace lsdcd
