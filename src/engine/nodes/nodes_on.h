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
    if (!e_.settings_.nodes) return;
    nodes_ = std::vector<MovingNodes<B>>(e_.settings_.meshes);
    forces_ = std::vector<NodeForces<B>>(e_.settings_.meshes);
  }

  void start(int mesh, const WeldedMesh &at_rest) override
  {
    const EngineSettings &s = e_.settings_;
    nodes_.at(mesh).start(e_.b_, at_rest, s.side != Side::both,
                          s.law().rolling.is_on() || s.law().twisting.is_on());
  }
  void take_over(NodeEngine &from) override
  {
    auto &other = dynamic_cast<NodesOn &>(from);
    other.e_.b_.wait();
    nodes_.swap(other.nodes_);
    forces_.swap(other.forces_);
  }

  void give(int mesh, const Vec3 *x, const Vec3 *v) override { nodes_.at(mesh).give(e_.b_, x, v); }
  void give_in_place(int mesh, const Real *x, const Real *v,
                     const std::vector<int> &node_of_row) override
  {
    nodes_.at(mesh).give_in_place(e_.b_, x, v, node_of_row);
  }
  NodesGone move(int mesh, Real back) override { return nodes_.at(mesh).move(e_.b_, back); }
  void move_back(int mesh) override { nodes_.at(mesh).move_back(e_.b_); }
  NodesGone put(int mesh, const Vec3 *x, const Vec3 *v, Real back) override
  {
    return nodes_.at(mesh).put(e_.b_, x, v, back);
  }
  Real velocities_behind(int mesh) const override { return nodes_.at(mesh).velocities_behind(); }
  void build_grid(int mesh, const MovingGridSettings &settings, Real going) override
  {
    e_.where_step_runs([&] {
      e_.broad_phase_.set_lists(e_.b_, nodes_.at(mesh).build_grid(e_.b_, settings, going), mesh);
    });
  }

  void turn_springs(int n, int mesh) override
  {
    TurningMesh turning;
    if (!nodes_.at(mesh).turn(turning)) return;
    e_.where_step_runs([&] {
      e_.springs_.grow(n);
      e_.springs_.turn(n, static_cast<std::uint32_t>(mesh), turning);
    });
  }

  void see_forces(int mesh) override
  {
    const MovingNodes<B> &nodes = nodes_.at(mesh);
    forces_.at(mesh).see(e_.b_,
                         e_.results_.node_contacts(e_.springs_.contacts(e_.step_.update_history),
                                                   mesh, nodes.records(), nodes.field().velocity),
                         nodes.n());
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
  void put_forces(int mesh, Real sixth, Real *to, const std::vector<int> &node_of_row) override
  {
    MovingNodes<B> &nodes = nodes_.at(mesh);
    const int *rows = nodes.rows(e_.b_, node_of_row);
    e_.b_.for_each(node_of_row.size(),
                   ForceOfNode{nodes.faces(), nodes.face_first(), nodes.faces_around(), nodes.at(),
                               forces_[mesh].sums(), forces_[mesh].range_in_place(), rows, sixth,
                               to});
  }

  void fetch(int mesh, NodesAt when, Vec3 *x, Vec3 *v) override
  {
    nodes_.at(mesh).fetch(e_.b_, when, x, v);
  }

  // Returns what steps read of the nodes of a mesh; nothing of one that has none.
  NodeField field(int mesh) const { return nodes_.empty() ? NodeField() : nodes_[mesh].field(); }
  std::size_t bytes() const
  {
    std::size_t bytes = 0;
    for (const MovingNodes<B> &nodes : nodes_) bytes += nodes.bytes();
    for (const NodeForces<B> &forces : forces_) bytes += forces.bytes();
    return bytes;
  }

 private:
  EngineOn<B> &e_;
  std::vector<MovingNodes<B>> nodes_;    // of each mesh
  std::vector<NodeForces<B>> forces_;    // of each mesh
};

}    // namespace lsdcd
