// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh whose nodes, its welded vertices, are where the caller puts them in each step: its records, its grid, and
// the forces of contacts on its nodes. Every process has all nodes.
//
// Lists, of cells (grid/build/moving_grid.h) and of spheres (engine/nodes/node_list.h), go by distance alone, as a region
// that a list left out may turn towards the sphere.
#pragma once

#include "engine/engine.h"
#include "engine/nodes/node_engine.h"
#include "grid/flat_grid.h"
#include "host/host.h"
#include "wall/mesh_state.h"
#include "wall/wall_spec.h"

#include <memory>
#include <vector>

namespace lsdcd {

class MeshNodes {
 public:
  // The mesh with this number, from 0, as it was welded: its nodes are there, at rest, until they are set. Host and
  // wall must outlive it.
  MeshNodes(Host &host, const WallSpec &wall, int mesh, const WeldedMesh &welded);
  ~MeshNodes();

  int count() const { return static_cast<int>(mesh_.vertices.size()); }

  // Places (length) and velocities (length/time) of the nodes from the next step on: x y z, node after node. Velocities
  // are of the same time as those of spheres. `v` null: all are 0.
  void set(const Real *x, const Real *v);
  // Sets places and velocities, as set() does, from arrays that lie where the wall computes, in the order of its
  // engine's stream: row k is of node node_of_row[k], which is the same in each call. Returns false where nothing was
  // read, as the engine does not have the nodes; then give them to set().
  bool set_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row);

  // Begins a step: nodes go to where they were set. `cutoff`: 0 while there are no spheres. Throws InputError, which
  // names the node or face, where one is at no finite place, has no area, or has gone farther than the cutoff in one
  // step, as it may have gone through a sphere.
  void begin_step(const Step &step, Real cutoff);

  // Returns where the nodes are in this step. Waits where the engine has moved them.
  const WeldedMesh &mesh() const
  {
    fetch_places();
    return mesh_;
  }
  Box bounds() const { return {mesh_.report.lo, mesh_.report.hi}; }    // of them
  NodeField field(Real cutoff) const;

  // Is another grid needed, as it is for another cutoff or a node has gone too far?
  bool needs_grid(Real cutoff);
  // Have nodes gone so far since candidates were chosen that the lists of spheres are no longer complete?
  bool needs_choice(Real cutoff) const;
  void note_choice() { way_ = 0; }
  // Builds it, where the engine has the nodes if it can.
  void build_grid(Real cutoff, WallEngine &engine);
  // Before the engine is another one, which needs a grid: gets all that the engine alone has.
  void leave_engine();
  // They may be those of an earlier step where the engine has copies of them.
  MeshFeaturesView records() const { return features_.view(); }

  // Turns the springs of spheres [0, n) with their features since the last step.
  void turn_springs(WallEngine &engine, int n);
  // For a saved state: where the nodes are, and their names.
  NodeState save() const;
  // Before the first step: nodes are where they were saved, to which springs belong, until the next step begins. A state
  // without places has springs of the step that comes.
  void restore(const NodeState &was);

  // After a step: sees what its contacts do to the nodes, on this process. Throws InputError, which names the sphere, where a force is
  // not finite; where nodes were set in place, the next step or who asks for forces does.
  void see_forces(WallEngine &engine);
  // Returns the range of what was seen, for that of all processes, where these are several.
  const SummandRange &range() const { return range_.shares; }
  // Then adds up what was seen.
  void add_forces(const SummandRange &of_all);
  void clear_forces();
  // In place of see_forces() and add_forces() on a process whose step has failed: it takes part in the sums of all with 0.
  void have_no_forces();
  // Sums over all processes, x y z, node after node (force): of contacts, and of `pressure` (force/area), which pushes
  // to where the normals of faces point by their winding, and outward on a closed mesh. Collective, once a step.
  const std::vector<Real> &forces(Real pressure);
  // Writes the sums that forces() returns to an array that lies where the wall computes, with rows as in
  // set_in_place(). Returns false where the sums are not there, or not those of all processes. Not collective. Does not
  // wait.
  bool put_forces(Real pressure, Real *to, const std::vector<int> &node_of_row);
  // Returns the moment of the forces of contacts on the nodes about the origin of the box, of all processes. Collective.
  Vec3 moment();
  // Returns the power of the mesh on the spheres of this process, by the motion of its nodes.
  Real power() const
  {
    fetch_power();
    return power_;
  }

  std::size_t bytes() const;

  // The names that the host has for nodes, for saved states; empty: none.
  std::vector<Real> names;
  // The row in the arrays of a program in which each node is, for messages; empty: nodes are in the order of their numbers.
  std::vector<int> rows;

 private:
  std::string named(const std::string &text) const;
  std::string node_text(std::size_t i) const;
  void find_spins();
  NodesNow now() const;
  void give_nodes(WallEngine &engine);
  void move_here(const Step &step, Real cutoff);
  void move_in_place(const Step &step, Real cutoff);
  void check_way(const Step &step, Real cutoff, Real most, const std::vector<Vec3> &from,
                 const std::vector<Vec3> &to) const;
  void check_velocities(const std::vector<Vec3> &v) const;
  void fetch_places() const;
  void fetch_power() const;
  void fetch_records();
  void fetch_forces();
  void sum_forces();
  bool take_range();
  [[noreturn]] void fail_force() const;
  Real sixth_of(Real pressure) const;

  Host &host_;
  const WallSpec &wall_;
  int index_;
  bool with_sides_, with_spins_;
  NodeEngine *engine_ = nullptr;    // the engine, where it has the nodes, from its first grid on
  mutable WeldedMesh mesh_;
  MeshFeatures features_;
  mutable std::vector<Vec3> velocity_;
  std::vector<Vec3> spin_;
  std::vector<Vec3> next_, next_velocity_;    // set for the next step; empty: as they are
  Real cutoff_ = 0;                           // of the grid; 0: there is none
  // Who includes this need not compile what a backend does.
  struct CpuGrid;
  std::unique_ptr<CpuGrid> grid_;    // without engine_, once it is built
  FlatGrid records_;                 // with it, as they were when it got the nodes
  Real back_ = 0;                    // how long ago velocities are of (time)
  Real way_ = 0;                     // of the fastest node in each step since the choice
  Real way_of_grid_ = 0;             // at least how far a node has gone since the grid was built
  std::vector<Vec3> built_at_;       // where nodes were when the grid was built, without engine_
  std::vector<Vec3> turned_from_;    // where nodes were when springs were turned last
  bool have_moved_ = false, springs_are_new_ = true;    // since then
  // What the engine alone has: records, places and velocities in this step, and in the next, forces, the power.
  bool are_records_old_ = false, are_given_there_ = false, are_forces_old_ = false;
  mutable bool are_places_old_ = false, is_power_old_ = false;
  bool are_sums_there_ = false;      // engine_ has forces of the last step
  NodeEngine *summing_ = nullptr;    // the engine that has the forces of the last step
  NodeForceRange range_ = {};
  bool is_range_new_ = false;         // summing_ has a range that nobody has looked at
  std::vector<std::int64_t> sums_;    // of contacts, in units of range_
  std::vector<Real> of_contacts_, forces_;
  mutable Real power_ = 0;
  bool are_summed_ = true;    // of_contacts_ are those of all processes
};

}    // namespace lsdcd
