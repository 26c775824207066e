// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The records of a mesh whose nodes have moved, made by a backend and brought to the CPU.
#pragma once

#include "engine/nodes/moving_nodes.h"
#include "mesh/mesh_features.h"

namespace lsdcd {

template <class B>
MeshFeatures records_on_cpu(B &b, const MovingNodes<B> &nodes, const WeldedMesh &mesh)
{
  const MeshFeaturesView &from = nodes.records();
  MeshFeatures to = make_moving_features(mesh, true);
  const auto fetch = [&](const auto *records, auto &rows) {
    b.copy_out(records, rows.data(), rows.size());
  };
  fetch(from.faces, to.faces);
  fetch(from.edges, to.edges);
  fetch(from.vertices, to.vertices);
  fetch(from.edge_inward, to.edge_inward);
  fetch(from.vertex_direction, to.vertex_direction);
  fetch(from.face_parts, to.face_parts);
  fetch(from.edge_out, to.edge_out);
  fetch(from.vertex_out, to.vertex_out);
  b.wait();
  return to;
}

// `mesh`: before it moves to where `after` is.
template <class B>
MeshFeatures moved_records_by(B b, const WeldedMesh &mesh, const WeldedMesh &after)
{
  MovingNodes<B> nodes;
  nodes.start(b, mesh, true, false);
  nodes.give(b, after.vertices.data(), nullptr);
  nodes.move(b, 0);
  return records_on_cpu(b, nodes, mesh);
}

// In a build with CUDA.
MeshFeatures moved_records_on_cuda(const WeldedMesh &mesh, const WeldedMesh &after);

}    // namespace lsdcd
