// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine on one backend does for meshes whose nodes move.
#pragma once

#include "engine/nodes/moving_nodes.h"
#include "engine/nodes/node_engine.h"
#include "engine/nodes/node_forces.h"
#include "mesh/face_pressure.h"

#include <vector>

namespace lsdcd {

template <class B>
class EngineOn;

// The force on the node of row k: of contacts, and of faces that push it in the order of their numbers, as on a host.
struct ForceOfNode {
  const int *faces, *first, *around;
  const Vec3 *at;
  const std::int64_t *sums;
  const NodeForceRange *range;
  const int *node_of_row;
  Real sixth;
  Real *to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = node_of_row[k];
    const SumUnit unit(range->shares);
    Vec3 sum;
    for (int d = 0; d < 3; d++) sum[d] = unit.value(sums[3 * i + d]);
    for (int m = first[i]; sixth != 0 && m < first[i + 1]; m++)
      sum += corner_share_of_pressure(faces + 3 * std::size_t(around[m]), at, sixth);
    for (int d = 0; d < 3; d++) to[3 * k + d] = sum[d];
  }
};

template <class B>
class NodesOn : public NodeEngine {
 public:
  // The engine must outlive it, and has its settings already.
  explicit NodesOn(EngineOn<B> &engine) : e_(engine)
  {
    const EngineSettings &s = e_.settings_;
    if (s.nodes) forces_ = std::vector<NodeForces<B>>(s.meshes);
    if (s.nodes && (!B::kOnCpu || s.copies_records)) nodes_ = std::vector<MovingNodes<B>>(s.meshes);
  }

  bool keeps_nodes() const override { return !nodes_.empty(); }

  void turn_springs(int n, int mesh, const TurningMesh &turning) override
  {
    e_.where_step_runs([&] {
      e_.springs_.grow(n);
      e_.springs_.turn(n, static_cast<std::uint32_t>(mesh),
                       keeps_nodes() ? nodes_[mesh].turning(records_of(mesh)) : turning);
    });
  }

  void see_forces(int mesh, const NodesNow &now, const MeshFeaturesView &wall) override
  {
    const bool keeps = keeps_nodes();
    const Vec3 *velocity = keeps ? nodes_[mesh].field(0).velocity : now.velocity;
    const NodeContacts in =
        e_.results_.node_contacts(e_.springs_.contacts(e_.step_.update_history), mesh,
                                  keeps ? records_of(mesh) : wall, velocity);
    forces_.at(mesh).see(e_.b_, in, keeps ? nodes_[mesh].n() : now.mesh->vertices.size());
  }
  NodeForceRange force_range(int mesh) override { return forces_.at(mesh).range(); }
  void add_forces(int mesh, const NodeForceRange *of_all) override
  {
    forces_.at(mesh).add(e_.b_, of_all);
  }
  Real fetch_forces(int mesh, std::int64_t *sums) override
  {
    return forces_.at(mesh).fetch(e_.b_, sums);
  }

  void start(int mesh, const NodesNow &now) override { nodes_.at(mesh).start(e_.b_, now); }
  void give(int mesh, const Vec3 *x, const Vec3 *v) override { nodes_.at(mesh).give(e_.b_, x, v); }
  void give_in_place(int mesh, const Real *x, const Real *v,
                     const std::vector<int> &node_of_row) override
  {
    nodes_.at(mesh).give_in_place(e_.b_, x, v, node_of_row);
  }
  NodesGone move(int mesh, bool with_spins, Real back) override
  {
    return nodes_.at(mesh).move(e_.b_, records_of(mesh), with_spins, back);
  }
  NodesGone move_back(int mesh, bool with_spins, Real back) override
  {
    return nodes_.at(mesh).move_back(e_.b_, records_of(mesh), with_spins, back);
  }
  void make_left(int mesh, const WeldedMesh &now) override
  {
    nodes_.at(mesh).make_left(e_.b_, records_of(mesh), now);
  }
  void build_grid(int mesh, const MovingGridSettings &settings) override
  {
    e_.where_step_runs([&] {
      const GridView lists = nodes_.at(mesh).build_grid(e_.b_, settings, records_of(mesh));
      e_.broad_phase_.set_lists(e_.b_, lists, mesh);
    });
  }

  void fetch(int mesh, NodesAt when, Vec3 *x, Vec3 *v) override
  {
    nodes_.at(mesh).fetch(e_.b_, when, x, v);
  }
  void fetch_records(int mesh, MeshFeatures &to) override
  {
    const MeshFeaturesView &from = records_of(mesh);
    const auto fetch = [&](const auto *from, auto &rows) {
      e_.b_.copy_out(from, rows.data(), rows.size());
    };
    fetch(from.faces, to.faces);
    fetch(from.edges, to.edges);
    fetch(from.vertices, to.vertices);
    fetch(from.edge_inward, to.edge_inward);
    fetch(from.vertex_direction, to.vertex_direction);
    fetch(from.face_parts, to.face_parts);
    fetch(from.edge_out, to.edge_out);
    fetch(from.vertex_out, to.vertex_out);
    e_.b_.wait();
  }
  void put_forces(int mesh, Real sixth, Real *to, const std::vector<int> &node_of_row) override
  {
    MovingNodes<B> &nodes = nodes_.at(mesh);
    const int *rows = nodes.rows(e_.b_, node_of_row);
    e_.b_.for_each(node_of_row.size(),
                   ForceOfNode{nodes.faces(), nodes.face_first(), nodes.faces_around(), nodes.at(),
                               forces_[mesh].sums(), forces_[mesh].range_in_place(), rows, sixth,
                               to});
  }

  // Returns what steps read of the nodes of a mesh that it keeps.
  NodeField field(int mesh, Real going) const { return nodes_[mesh].field(going); }
  std::size_t bytes() const
  {
    std::size_t bytes = 0;
    for (const MovingNodes<B> &nodes : nodes_) bytes += nodes.bytes();
    for (const NodeForces<B> &forces : forces_) bytes += forces.bytes();
    return bytes;
  }

 private:
  const MeshFeaturesView &records_of(int mesh) const
  {
    return e_.broad_phase_.mesh(mesh).grid.view.wall;
  }

  EngineOn<B> &e_;
  std::vector<MovingNodes<B>> nodes_;    // of each mesh, where it keeps them
  std::vector<NodeForces<B>> forces_;    // of each mesh
};

}    // namespace lsdcd
