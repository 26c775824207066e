// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An engine that hands each call to another one. Who gives an engine other spheres overrides what takes them.
#pragma once

#include "engine/engine.h"

#include <memory>
#include <utility>

namespace lsdcd {

// The state of a step (state_) stays with the class that overrides begin(), submit() and collect().
class ForwardingEngine : public WallEngine {
 public:
  explicit ForwardingEngine(std::unique_ptr<WallEngine> engine) : engine_(std::move(engine)) {}

  std::string backend() const override { return engine_->backend(); }
  void set_pose(const Pose &pose, int mesh) override { engine_->set_pose(pose, mesh); }
  bool is_under_way() const override { return engine_->is_under_way(); }

  StepResults &results() override { return engine_->results(); }
  Springs &springs() override { return engine_->springs(); }
  StepDiagnostics read_diagnostics() override { return engine_->read_diagnostics(); }

  NodesInPlace *nodes_in_place() override { return engine_->nodes_in_place(); }
  void turn_springs(int n, int mesh, const TurningMesh &turning) override
  {
    engine_->turn_springs(n, mesh, turning);
  }
  void see_node_forces(int mesh, const NodesNow &now, const MeshFeaturesView &wall) override
  {
    engine_->see_node_forces(mesh, now, wall);
  }
  NodeForceRange node_force_range(int mesh) override { return engine_->node_force_range(mesh); }
  void add_node_forces(int mesh, const NodeForceRange *of_all) override
  {
    engine_->add_node_forces(mesh, of_all);
  }
  Real fetch_node_forces(int mesh, std::int64_t *sums) override
  {
    return engine_->fetch_node_forces(mesh, sums);
  }
  int n_candidates() const override { return engine_->n_candidates(); }
  std::size_t bytes() const override { return engine_->bytes(); }

 protected:
  void put_grid(const GridView &grid, int mesh) override { engine_->set_grid(grid, mesh); }
  void build_grid_of_nodes(int mesh, const MovingGridSettings &settings) override
  {
    engine_->build_node_grid(mesh, settings);
  }

  std::unique_ptr<WallEngine> engine_;
};

}    // namespace lsdcd
