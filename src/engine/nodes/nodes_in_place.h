// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine that has copies of the records of meshes whose nodes move does with the nodes, as on a GPU. Such an
// engine takes views of flat blocks only. Places, velocities and forces of nodes stay where it computes: a host asks for
// them where it needs them.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace lsdcd {

// How nodes have gone in a step.
struct NodesGone {
  Real most;          // how far one has gone, at most (length); HUGE_VAL where one is no number
  Real since_grid;    // likewise, since the grid was built
  Real speed;         // the largest (length/time); likewise
  Vec3 lo, hi;        // corners of their bounds
  bool any_left;      // is the CPU to make records, as they need more digits than a Real has?
};

// Before the last move, after it, and given for the next one.
enum class NodesAt { before, now, given };

class NodesInPlace {
 public:
  virtual ~NodesInPlace() = default;

  // After set_grid() of a mesh, with its records and without lists, once: records change by move_nodes() from here on, and
  // WallEngine::build_node_grid() makes the lists.
  virtual void start_nodes(int mesh, const NodesNow &now) = 0;
  // Where nodes will be, and their velocities: of each node, in the memory of the host.
  virtual void give_nodes(int mesh, const Vec3 *x, const Vec3 *v) = 0;
  // The same in the memory of the backend, in the order of its stream: x y z, where row k is of node node_of_row[k], which
  // is the same in each call of a mesh. `v` null: all are 0.
  virtual void give_nodes_in_place(int mesh, const Real *x, const Real *v,
                                   const std::vector<int> &node_of_row) = 0;
  // Nodes go to where they were given, and their records are made anew (mesh/moving_records.h). Before begin(). Waits
  // for what it returns only.
  virtual NodesGone move_nodes(int mesh, bool with_spins, Real back) = 0;
  // The CPU makes the records that move_nodes() has left to it. Throws InputError where a face has no area.
  virtual void make_left(int mesh, const WeldedMesh &now) = 0;
  // After a step that is refused: nodes go back to where they were.
  virtual NodesGone move_nodes_back(int mesh, bool with_spins, Real back) = 0;

  // These wait. Arrays have as many items as there are nodes or records.
  virtual void fetch_nodes(int mesh, NodesAt when, Vec3 *x, Vec3 *v) = 0;
  virtual void fetch_records(int mesh, MeshFeatures &to) = 0;

  // Puts the forces of WallEngine::add_node_forces() where the backend computes, row k of node node_of_row[k], as in
  // give_nodes_in_place(), with the forces of a pressure, of which this is a sixth (mesh/face_pressure.h). They are no
  // numbers where a contact's force is not finite. Does not wait.
  virtual void put_node_forces(int mesh, Real sixth, Real *to,
                               const std::vector<int> &node_of_row) = 0;
};

}    // namespace lsdcd
