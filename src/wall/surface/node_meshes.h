// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The meshes of a wall whose nodes move: what is done for all of them in a step.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "wall/mesh_nodes.h"
#include "wall/step_totals.h"

#include <vector>

namespace lsdcd {

class NodeMeshes {
 public:
  // `host` must outlive it.
  explicit NodeMeshes(Host &host) : host_(host) {}

  // Adds the next mesh of the wall with its nodes, which must stay; null: it has none that move.
  void add(MeshNodes *nodes);
  bool any() const { return !all_.empty(); }

  // Before the engine is another one.
  void leave_engine();
  // Before spheres are chosen: makes the grids that are due, and turns the springs of spheres [0, n) with their features.
  // Each process has all nodes, and comes to the same grids. Local.
  void begin_choice(WallEngine &engine, Real cutoff, int n);
  void note_choice();
  // Returns the field of each mesh of the wall, until the next call; null where none has nodes.
  const NodeField *fields(Real cutoff);

  // After a step: sees what its contacts do to the nodes. Local.
  void see_forces(WallEngine &engine);
  // Gives the forces the range of all processes where these are several, by one message. Collective. `failed`: this process has
  // none, as its step failed; then there are none on the others, which do not wait for it.
  void agree_on_forces(bool failed);
  void clear_forces();
  // Returns the loads of each mesh of the wall; empty where none has nodes. Collective.
  std::vector<NodeLoad> loads();

 private:
  Host &host_;
  std::vector<MeshNodes *> of_mesh_;    // null: it has none
  std::vector<MeshNodes *> all_;
  std::vector<NodeField> fields_;
};

}    // namespace lsdcd
