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

  // Gives the nodes to the first engine; another one gets them from the last, which must be there still. Collective.
  void set_engine(WallEngine &engine);
  // Before spheres are chosen: makes the grids that are due, and turns the springs of spheres [0, n) with their features.
  // Each process has all nodes, and comes to the same grids. Local.
  void begin_choice(Real cutoff, int n);
  void note_choice();

  // After a step: sees what its contacts do to the nodes. Local.
  void see_forces();
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
  WallEngine *engine_ = nullptr;
};

}    // namespace lsdcd
