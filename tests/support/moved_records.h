// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The records of a mesh whose nodes have moved, made by a backend and brought to the CPU.
#pragma once

#include "engine/nodes/moving_nodes.h"
#include "mesh/mesh_features.h"

#include <vector>

namespace lsdcd {

// `mesh`: before it moves to where `after` is.
template <class B>
MeshFeatures moved_records_by(B b, const WeldedMesh &mesh, const WeldedMesh &after)
{
  MeshFeatures features = make_moving_features(mesh, true);
  const std::vector<Vec3> at_rest(mesh.vertices.size(), Vec3{0, 0, 0});
  const auto faces = from_cpu(b, features.faces);
  const auto edges = from_cpu(b, features.edges);
  const auto vertices = from_cpu(b, features.vertices);
  const auto edge_inward = from_cpu(b, features.edge_inward);
  const auto vertex_direction = from_cpu(b, features.vertex_direction);
  const auto edge_out = from_cpu(b, features.edge_out);
  const auto vertex_out = from_cpu(b, features.vertex_out);
  const auto face_parts = from_cpu(b, features.face_parts);
  MeshFeaturesView records = {};
  records.faces = faces.data();
  records.edges = edges.data();
  records.vertices = vertices.data();
  records.edge_inward = edge_inward.data();
  records.vertex_direction = vertex_direction.data();
  records.edge_out = edge_out.data();
  records.vertex_out = vertex_out.data();
  records.face_parts = face_parts.data();

  MovingNodes<B> nodes;
  nodes.start(b, {&mesh, &features.primitives, at_rest.data(), false, 0});
  nodes.give(b, after.vertices.data(), at_rest.data());
  if (nodes.move(b, records, false, 0).any_left) nodes.make_left(b, records, after);
  features.faces = to_cpu(b, faces, faces.size());
  features.edges = to_cpu(b, edges, edges.size());
  features.vertices = to_cpu(b, vertices, vertices.size());
  features.edge_inward = to_cpu(b, edge_inward, edge_inward.size());
  features.vertex_direction = to_cpu(b, vertex_direction, vertex_direction.size());
  features.edge_out = to_cpu(b, edge_out, edge_out.size());
  features.vertex_out = to_cpu(b, vertex_out, vertex_out.size());
  features.face_parts = to_cpu(b, face_parts, face_parts.size());
  return features;
}

// In a build with CUDA.
MeshFeatures moved_records_on_cuda(const WeldedMesh &mesh, const WeldedMesh &after);

}    // namespace lsdcd
