// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh whose nodes, its welded vertices, are where the caller puts them in each step. The engine has them, with records, grid
// and the forces of contacts on them (engine/nodes/node_engine.h); this says when what is done, and checks it. Every process
// has all nodes.
//
// Lists, of cells (grid/build/moving_grid.h) and of spheres (engine/nodes/node_list.h), go by distance alone, as a region
// that a list left out may turn towards the sphere.
#pragma once

#include "engine/engine.h"
#include "engine/nodes/node_engine.h"
#include "host/host.h"
#include "wall/saved/mesh_state.h"
#include "wall/spec/wall_spec.h"

#include <vector>

namespace lsdcd {

class MeshNodes {
 public:
  // Takes this mesh of the wall, counted from 0, as it was welded: its nodes are there, at rest, until they are set. Host and wall must
  // outlive this object.
  MeshNodes(Host &host, const WallSpec &wall, int mesh, const WeldedMesh &welded);

  int count() const { return static_cast<int>(mesh_.vertices.size()); }

  // Gives the nodes to an engine. Called before all other functions except mesh() and bounds(). Throws InputError if the mesh is too large
  // for the engine.
  void start(WallEngine &engine);
  // Continues in another engine, which has taken the nodes (WallEngine::take_nodes()) and has no grids.
  void forget_grid() { cutoff_ = 0; }

  // Sets places (length) and velocities (length/time) of the nodes from the next step on: x y z, node after node. Velocities are of the
  // same time as those of spheres. `v` null: all are 0.
  void set(const Real *x, const Real *v);
  // Sets places and velocities, as set() does, from arrays that lie where the wall computes, in the order of its
  // engine's stream: row k is of node node_of_row[k], which is the same in each call.
  void set_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row);

  // Begins a step: nodes go to where they were set. `cutoff`: 0 while there are no spheres. Throws InputError, which names the node or
  // face, if a node is at no finite place, if a face has no area, or if a node has gone farther than the cutoff in one step, because it may
  // have gone through a sphere. The nodes are then where they were.
  void begin_step(const Step &step, Real cutoff);

  // Returns where the nodes are in this step. Waits.
  const WeldedMesh &mesh() const;
  Box bounds() const { return {mesh_.report.lo, mesh_.report.hi}; }    // of them

  // Returns whether a new grid is needed, because this one is for another cutoff or a node has gone too far.
  bool needs_grid(Real cutoff) const;
  // Returns whether nodes have moved so far since the last candidate search that the lists of spheres are no longer complete.
  bool needs_choice(Real cutoff) const;
  void note_choice() { way_ = 0; }
  void build_grid(Real cutoff);

  // Turns the springs of spheres [0, n) with their features since the last step.
  void turn_springs(int n) { engine_->turn_springs(n); }
  // Returns, for a saved state, where the nodes are and will be, their names, and the forces on them. Collective.
  NodeState save();
  // Throws InputError, which names the node or face, if restore() would put a node at no finite place, or make a face without area.
  void check(const NodeState &was) const;
  // Takes a state that was checked, before the first step: nodes are where they were saved, to which springs belong, until the
  // next step begins. A state without places has springs of the step that comes.
  void restore(const NodeState &was);

  // Makes the engine look, after a step, at what contacts do to the nodes on this process. Throws InputError, which names the sphere, if a
  // force is not finite; if nodes were set in place, the next step throws it, or what asks for forces.
  void see_forces();
  // Returns the range of what see_forces() has found. Several processes make their common range of these.
  const SummandRange &range() const { return range_.shares; }
  // Adds up the forces that see_forces() has found, in units of the range of all processes.
  void add_forces(const SummandRange &of_all);
  void clear_forces();
  // Takes the place of see_forces() and add_forces() on a process whose step has failed, so that it adds 0 to the sums of all processes.
  void have_no_forces();
  // Returns the forces on the nodes, summed over all processes, x y z, node after node: those of contacts, and those of `pressure`
  // (force/area), which pushes to where the normals of faces point by their winding, and outward on a closed mesh. Collective, once a step.
  const std::vector<Real> &forces(Real pressure);
  // Writes the sums that forces() returns to an array that lies where the wall computes, with rows as in set_in_place(). Returns false if
  // there are none, or not those of all processes. Not collective. Does not wait.
  bool put_forces(Real pressure, Real *to, const std::vector<int> &node_of_row);
  // Returns the moment of the forces of contacts on the nodes about the origin of the box, of all processes. Collective.
  Vec3 moment();
  // Returns the power of the mesh on the spheres of this process, by the motion of its nodes.
  Real power();

  std::size_t bytes() const;    // beside the engine's

  // The names that the host has for nodes, for saved states; empty: none.
  std::vector<Real> names;
  // The row in the arrays of a program in which each node is, for messages; empty: nodes are in the order of their numbers.
  std::vector<int> rows;

 private:
  std::string named(const std::string &text) const;
  std::string node_text(std::size_t i) const;
  void check(const NodesGone &gone, const Step &step, Real cutoff) const;
  void check_place(std::size_t node, const Vec3 &x) const;
  void check_velocity(std::size_t node, const Vec3 &v) const;
  void note(const NodesGone &gone);
  void check_range();
  void fetch_forces();
  Real sixth_of(Real pressure) const;

  // How far the forces of the last step have come: there are none; the engine has seen them, and nobody has looked at
  // their range; it has added them up, or will; this process has its sums; it has those of all processes; they are those of a
  // saved state.
  enum class Forces { none, seen, added, fetched, of_all, restored };

  Host &host_;
  const WallSpec &wall_;
  int index_;
  NodeEngine *engine_ = nullptr;
  mutable WeldedMesh mesh_;
  mutable bool are_places_old_ = false;    // the engine has moved the nodes since they were fetched
  bool are_set_ = false, are_set_in_place_ = false;    // for the next step; the last time
  bool are_restored_ = false;                          // a saved state has set them
  Real cutoff_ = 0;                                    // of the grid; 0: there is none
  Real way_ = 0;            // of the fastest node in each step since the candidate search
  Real way_of_grid_ = 0;    // how far a node has gone since the grid was built
  Forces state_ = Forces::none;
  NodeForceRange range_ = {};
  std::vector<std::int64_t> sums_;    // of contacts, in units of range_
  std::vector<Real> of_contacts_, forces_;
  Real power_ = 0;
};

}    // namespace lsdcd
