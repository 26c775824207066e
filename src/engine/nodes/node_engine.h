// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What an engine does for meshes whose nodes move: springs turn with their features, forces go to the nodes. Where it keeps
// nodes and records itself, as on a GPU, it takes views of flat blocks only, and places, velocities and forces of nodes stay
// where it computes: a host asks for them where it needs them.
#pragma once

#include "engine/engine.h"

#include <vector>

namespace lsdcd {

struct MovingGridSettings;    // grid/build/moving_grid.h

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

class NodeEngine {
 public:
  virtual ~NodeEngine() = default;

  // Returns whether the engine keeps nodes and records. Else the host does, and hands over grids and `now`.
  virtual bool keeps_nodes() const = 0;

  // Turns the springs of the spheres [0, n) on a mesh with their features, before a step, in the frame of the mesh. An engine
  // that keeps nodes knows where they were before, and reads nothing of `turning`.
  virtual void turn_springs(int n, int mesh, const TurningMesh &turning) = 0;

  // The forces of the contacts of the last step on the nodes of a mesh, in fixed point. step.contacts need not be set. An
  // engine that keeps nodes reads nothing of `now` and `wall`. All follow each other after a step: what they read of
  // spheres and nodes is as in collect().
  //
  // Sees the contacts on this process. Does not wait.
  virtual void see_forces(int mesh, const NodesNow &now, const MeshFeaturesView &wall) = 0;
  // Returns the range of what was seen. Waits.
  virtual NodeForceRange force_range(int mesh) = 0;
  // Adds up what was seen, in units of the range of all processes, or of this one's own where it is null. Does not wait.
  virtual void add_forces(int mesh, const NodeForceRange *of_all) = 0;
  // Copies the sums in units of SumUnit(range.shares), x y z, node after node, if `sums` is not null; none are made
  // where a force is not finite. Returns the power of the nodes on the spheres. Waits.
  virtual Real fetch_forces(int mesh, std::int64_t *sums) = 0;

  // The following is for an engine that keeps nodes.

  // Takes the nodes of a mesh, after set_grid() with its records and without lists, once: records change by move() from here
  // on, and build_grid() makes the lists.
  virtual void start(int mesh, const NodesNow &now) = 0;
  // Takes where nodes will be, and their velocities: of each node, in the memory of the host.
  virtual void give(int mesh, const Vec3 *x, const Vec3 *v) = 0;
  // Takes the same in the memory of the backend, in the order of its stream: x y z, where row k is of node node_of_row[k], which
  // is the same in each call of a mesh. `v` null: all are 0.
  virtual void give_in_place(int mesh, const Real *x, const Real *v,
                             const std::vector<int> &node_of_row) = 0;
  // Moves nodes to where they were given, and makes their records again (mesh/moving_records.h). Before begin(). Waits
  // for what it returns only.
  virtual NodesGone move(int mesh, bool with_spins, Real back) = 0;
  // Makes the records that move() has left to the CPU. Throws InputError where a face has no area.
  virtual void make_left(int mesh, const WeldedMesh &now) = 0;
  // Moves nodes back to where they were, after a step that is refused.
  virtual NodesGone move_back(int mesh, bool with_spins, Real back) = 0;
  // Builds the grid of a mesh from where its nodes are now, to use from now on, by grid/build/moving_grid.h. The
  // host calls WallEngine::expire_choice().
  virtual void build_grid(int mesh, const MovingGridSettings &settings) = 0;

  // These wait. Arrays have as many items as there are nodes or records.
  virtual void fetch(int mesh, NodesAt when, Vec3 *x, Vec3 *v) = 0;
  virtual void fetch_records(int mesh, MeshFeatures &to) = 0;

  // Puts the forces of add_forces() where the backend computes, row k of node node_of_row[k], as in
  // give_in_place(), with the forces of a pressure, of which this is a sixth (mesh/face_pressure.h). They are no
  // numbers where a contact's force is not finite. Does not wait.
  virtual void put_forces(int mesh, Real sixth, Real *to, const std::vector<int> &node_of_row) = 0;
};

}    // namespace lsdcd
