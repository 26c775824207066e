// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The work of an engine for a mesh whose nodes move: it has the nodes and the records, turns springs with their features, and
// applies forces to the nodes. Places, velocities and forces of nodes stay in the memory of the engine; a host asks for them
// when it needs them.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace lsdcd {

struct MovingGridSettings;    // grid/build/moving_grid.h
struct WeldedMesh;

// How far nodes have moved in a step. A distance or a speed is HUGE_VAL if one of its numbers is not a number.
struct NodesGone {
  Real most;           // the largest distance that a node has moved (length)
  Real since_grid;     // the same since the grid was built (length)
  Real speed;          // the largest speed (length/time)
  Vec3 lo, hi;         // corners of their bounds
  int without_area;    // the first face that has no area any more, or -1
};

// Before the last move, after it, and the next places that were given since.
enum class NodesAt { before, now, next };

class NodeEngine {
 public:
  virtual ~NodeEngine() = default;

  // Takes the mesh, whose nodes are at rest at its vertices. Must be called before all other functions. Throws InputError if the
  // mesh is too large.
  virtual void start(const WeldedMesh &at_rest) = 0;

  // Takes the next places of all nodes, and their velocities, in the memory of the host. `v` null: all velocities are 0.
  virtual void give(const Vec3 *x, const Vec3 *v) = 0;
  // Takes the next places and velocities from memory of the backend, in the order of its stream: x y z, where row k is that of node
  // node_of_row[k], which is the same in each call.
  virtual void give_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row) = 0;
  // Moves nodes to the places that were given, and makes their records again (mesh/moving_records.h). Must be called before
  // begin(). `back`: how long before now the velocities are valid (time). Waits only for what it returns.
  virtual NodesGone move(Real back) = 0;
  // Moves nodes back to where they were, after a step that is refused.
  virtual void move_back() = 0;
  // Puts nodes where they were in a saved state, to which springs belong, with velocities that are valid `back` (time) before
  // now. Places that were given for the next move stay.
  virtual NodesGone put(const Vec3 *x, const Vec3 *v, Real back) = 0;
  // Returns how long before now the velocities are valid (time).
  virtual Real velocities_behind() const = 0;
  // Builds the grid from the present places of nodes, to be used from now on, by grid/build/moving_grid.h. Nodes move by up to
  // `going` (length) until the next candidate search. The host then calls WallEngine::expire_choice().
  virtual void build_grid(const MovingGridSettings &settings, Real going) = 0;

  // Turns the springs of the spheres [0, n) on the mesh with their features, to the present places of nodes, before a step, in
  // the frame of the mesh. They are turned from the places to which they were last turned, or at which put() has put the nodes.
  // The first call turns none unless put() was called.
  virtual void turn_springs(int n) = 0;

  // The forces of the contacts of the last step on the nodes, in fixed point; step.contacts need not be set. The functions are
  // called in this order after a step. What they read of spheres and nodes must not change, as until collect().
  //
  // Finds the range of the contacts on this process. Does not wait.
  virtual void see_forces() = 0;
  // Returns the range that was found. Waits.
  virtual NodeForceRange force_range() = 0;
  // Adds up the forces, in units that follow from the range of all processes, or if it is null from that of this process. Does
  // not wait.
  virtual void add_forces(const NodeForceRange *of_all) = 0;
  // Copies the sums in units of SumUnit(range.shares), x y z, node after node. There are no sums if a force is not finite.
  // Returns the power of the nodes on the spheres. Waits.
  virtual Real fetch_forces(std::int64_t *sums) = 0;
  // Writes the forces of add_forces() to memory of the backend, row k for node node_of_row[k], as in give_in_place(). Adds the
  // forces of a pressure, of which `sixth` is a sixth (mesh/face_pressure.h). They are not numbers if the force of a contact is
  // not finite. Does not wait.
  virtual void put_forces(Real sixth, Real *to, const std::vector<int> &node_of_row) = 0;

  // Copies the places and, if `v` is not null, the velocities of all nodes. Velocities before the last move are not available.
  // Waits.
  virtual void fetch(NodesAt when, Vec3 *x, Vec3 *v) = 0;
};

}    // namespace lsdcd
