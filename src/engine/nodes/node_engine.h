// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine does for a mesh whose nodes move: it has the nodes and the records, springs turn with their features,
// forces go to the nodes. Places, velocities and forces of nodes stay where it computes: a host asks for them where it
// needs them.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace lsdcd {

struct MovingGridSettings;    // grid/build/moving_grid.h
struct WeldedMesh;

// How nodes have gone in a step. A way, or the speed, is HUGE_VAL where one of its numbers is no number.
struct NodesGone {
  Real most;           // how far one has gone, at most (length)
  Real since_grid;     // how far one has gone since the grid was built, at most (length)
  Real speed;          // the largest (length/time)
  Vec3 lo, hi;         // corners of their bounds
  int without_area;    // the first face that has none any more, or -1
};

// Before the last move, after it, and where they were given since.
enum class NodesAt { before, now, next };

class NodeEngine {
 public:
  virtual ~NodeEngine() = default;

  // Takes the mesh, whose nodes are at rest at its vertices, before all that follows. Throws InputError where it is too large.
  virtual void start(const WeldedMesh &at_rest) = 0;

  // Takes where nodes will be, and their velocities, of each node, in the memory of the host. `v` null: all are 0.
  virtual void give(const Vec3 *x, const Vec3 *v) = 0;
  // Takes the same in the memory of the backend, in the order of its stream: x y z, where row k is of node node_of_row[k], which
  // is the same in each call.
  virtual void give_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row) = 0;
  // Moves nodes to where they were given, and makes their records again (mesh/moving_records.h). Before begin(). `back`: how
  // long ago velocities are of (time). Waits for what it returns only.
  virtual NodesGone move(Real back) = 0;
  // Moves nodes back to where they were, after a step that is refused.
  virtual void move_back() = 0;
  // Puts nodes where they were in a saved state, to which springs belong, with velocities of `back` ago (time). What was given
  // for the next move stays.
  virtual NodesGone put(const Vec3 *x, const Vec3 *v, Real back) = 0;
  // Returns how long ago the velocities are of (time).
  virtual Real velocities_behind() const = 0;
  // Builds the grid from where nodes are now, to use from now on, by grid/build/moving_grid.h. Nodes go by up to
  // `going` (length) until candidates are chosen. The host calls WallEngine::expire_choice().
  virtual void build_grid(const MovingGridSettings &settings, Real going) = 0;

  // Turns the springs of the spheres [0, n) on the mesh with their features to where nodes are, before a step, in its
  // frame: from where they were turned to last, or put() has put nodes. The first time none turns without put().
  virtual void turn_springs(int n) = 0;

  // The forces of the contacts of the last step on the nodes, in fixed point. step.contacts need not be set. All
  // follow each other after a step: what they read of spheres and nodes is as in collect().
  //
  // Sees the contacts on this process. Does not wait.
  virtual void see_forces() = 0;
  // Returns the range of what was seen. Waits.
  virtual NodeForceRange force_range() = 0;
  // Adds up what was seen, in units of the range of all processes, or of this one's own where it is null. Does not wait.
  virtual void add_forces(const NodeForceRange *of_all) = 0;
  // Copies the sums in units of SumUnit(range.shares), x y z, node after node; none are made where a force is not
  // finite. Returns the power of the nodes on the spheres. Waits.
  virtual Real fetch_forces(std::int64_t *sums) = 0;
  // Puts the forces of add_forces() where the backend computes, row k of node node_of_row[k], as in
  // give_in_place(), with the forces of a pressure, of which this is a sixth (mesh/face_pressure.h). They are no
  // numbers where a contact's force is not finite. Does not wait.
  virtual void put_forces(Real sixth, Real *to, const std::vector<int> &node_of_row) = 0;

  // Copies places and, where `v` is not null, velocities of all nodes; velocities before the last move are gone. Waits.
  virtual void fetch(NodesAt when, Vec3 *x, Vec3 *v) = 0;
};

}    // namespace lsdcd
