// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The interface between a host (the wall, the tool, tests, benches) and the engines.
#pragma once

#include "backend/cuda_available.h"
#include "base/strided_view.h"
#include "base/vec3.h"
#include "contact/contact_history.h"
#include "contact/feature_turn.h"
#include "contact/node_field.h"
#include "engine/candidate_schedule.h"
#include "engine/sum_unit.h"
#include "grid/triangle_grid.h"
#include "host/host_names.h"
#include "law/contact_law.h"
#include "law/law_table.h"
#include "law/wear.h"
#include "mesh/periodic_box.h"
#include "mesh/welded_mesh.h"
#include "motion/pose.h"
#include "motion/surface_motion.h"
#include "rigid/mobility.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

enum class Corner { blend, sum };
enum class Side { both, in, out };    // in the order of the keyword's words
enum class Device { automatic, cpu, cuda };

// Meshes that move apart, of one wall.
constexpr int kMaxMeshes = 32;

struct EngineSettings {
  LawTable laws = ContactLaw();
  Corner corner = Corner::blend;
  Side side = Side::both;
  int meshes = 1;           // that move apart; with more than one `moves` counts as true
  SurfaceMotion surface;    // of each mesh, in the plane of each contact
  bool moves = false;       // set_pose() or StepSettings::surface will be used
  bool contacts = false;    // keep what every contact does to the wall
  bool bodies = false;      // StepSettings::mobility will be used; contacts are recorded, too
  bool nodes = false;       // StepSettings::nodes will be used; likewise
  // The engine has copies of the records of meshes whose nodes move, as on a GPU, where this is so in any case.
  bool copies_records = false;
  WearModel wear = WearModel::none;    // where contacts are kept
  Device device = Device::automatic;
  int device_rank = 0;    // which of the GPUs this process takes (node-local rank, wrapped)
  HostNames names;        // for errors

  // Returns the first law of the table: the only one, or the sub-models of all.
  ContactLaw &law() { return laws.laws.front(); }
  const ContactLaw &law() const { return laws.laws.front(); }
};

// Are candidates sorted into slots, by mesh and by kind of sphere?
inline bool uses_slots(const EngineSettings &s)
{
  return s.meshes > 1 || s.laws.kinds > 1;
}

// Sphere data of a host code, borrowed for one step; n is the number of owned spheres.
struct Spheres {
  int n = 0;
  StridedView<const Real> x;        // length
  StridedView<const Real> v;        // length/time
  StridedView<const Real> omega;    // 1/time
  const Real *radius = nullptr;     // length
  const Real *mass = nullptr;       // mass that damping sees (a rigid member's body mass)
  const int *mask = nullptr;        // group bits, or null: all spheres
  int group_bit = 0;
  const int *type = nullptr;            // from 1; read where laws differ by it
  StridedView<Real> force;              // added to
  StridedView<Real> torque;             // added to
  const Real *temperature = nullptr;    // where the law has heat
  Real *heat_flow = nullptr;            // power; added to where the law has heat
};

struct StepSettings {
  std::int64_t number = 0;       // of the step, for StepDiagnostics
  Real dt = 0;                   // time
  bool update_history = true;    // false in setup: springs act but do not move
  bool synchronous =
      false;    // velocities are of the time of the places, as in setup; else of half a step before
  bool per_sphere = false;      // fill SphereOutput
  bool states = false;          // and TouchingSphere, where per_sphere is set
  bool totals = false;          // they will be asked for before the next step: summed with this one
  bool contacts = true;         // bring the contacts of settings.contacts
  Real wall_temperature = 0;    // where the law has heat
  // For each mesh, in place of wall_temperature and of the settings' surface; valid until collect().
  const Real *mesh_temperature = nullptr;
  const SurfaceMotion *surface = nullptr;
  // Likewise, where a mesh is a rigid body: how it gives way, which is 0 of others.
  const Mobility *mobility = nullptr;
  // Likewise, where the nodes of a mesh move: their velocities, which are null of others.
  const NodeField *nodes = nullptr;
};

// A mesh whose nodes move, as its host has it in this step.
struct NodesNow {
  const WeldedMesh *mesh;    // its vertices are where the nodes are
  const std::vector<FeatureCode> *primitives;
  const Vec3 *velocity;    // as in NodeField
  bool with_spins;         // else no law reads spins
  Real back;               // how long ago velocities are of (time)
};

// What is to be known of the forces of contacts on the nodes of a mesh before they are added.
struct NodeForceRange {
  SummandRange shares;    // components of the contacts' shares, of which a node has one a contact
  // kNoSphere less the index of the first sphere with one that is not finite, or 0.
  std::uint64_t not_finite;
};

// Sums over the spheres of the last step on this process.
struct WallTotals {
  Real energy = 0;            // elastic energy in normal overlaps and tangential springs
  Vec3 force = {0, 0, 0};     // on the mesh
  Vec3 torque = {0, 0, 0};    // on the mesh, about the origin
  std::int64_t contacts = 0;
  std::int64_t uncertified = 0;       // spheres whose answer was not certified exact
  Real largest_uncertain = 0;         // overlap / radius of the deepest contact they may miss
  Real largest_overlap_ratio = 0;     // overlap / radius
  int largest_overlap_sphere = -1;    // index in Spheres, -1 if none touches
  int pad = 0;                        // keeps the record free of indeterminate bytes
};

// One sphere's contacts in columns.
struct SphereOutput {
  Real contacts;    // number of contacts
  Vec3 force;       // sum over them, on the sphere
  Vec3 point;       // mean contact point on the wall, weighted by normal force
  Real radius;      // 0 where nothing touches
};

// A sphere with a contact, as the step has read it.
struct TouchingSphere {
  Vec3 x;
  Real radius, mass;
  int type;    // 0 where laws do not differ by it
  int pad;     // keeps the record free of indeterminate bytes
};

// The effect of one contact on the wall in one step.
struct StepContact {
  FeatureCode feature;
  std::uint32_t mesh;    // of the wall's
  Real normal;           // force on the wall, > 0 where the sphere presses
  Real shear;            // size of the force along the wall
  Real wear_power;       // see law/wear.h; 0 without wear
  // In the frame of the mesh:
  Vec3 force;    // on the wall
  Vec3 arm;      // from the closest point to the sphere's centre
};

// Counts of the steps since the host last read them.
struct StepDiagnostics {
  Real deepest = 0;                    // largest overlap / radius
  int deepest_sphere = -1;             // its index in the step that it was in
  int deepest_mesh = 0;                // of the wall's
  std::uint32_t deepest_meshes = 0;    // a bit for each mesh that this sphere touched then
  std::int64_t deepest_step = 0;       // StepSettings::number
  std::int64_t uncertified = 0;
  Real uncertain = 0;    // overlap / radius of the deepest contact they may have missed
  // Neighbour lists that were made, the features in them, and searches of cells for spheres without a list; all
  // are 0 where cells list the nearest primitives.
  std::int64_t lists = 0, listed = 0, by_cells = 0;
};

// A step is begun, submitted and collected.
enum class StepState { none, begun, submitted };

// When a step does its work, and where.
enum class When {
  in_turn,    // after the host's work on its stream; on a CPU collect() does it
  // In place on a GPU: at once, on a stream of its own, after the host's work on its stream by
  // begin(). collect() adds forces and torques.
  beside,
  beside_adding_early,    // likewise, but they are added after the host's work by submit()
};

// The springs of a process's spheres in the memory of an engine's backend, in which all pointers here lie. Each sphere has a
// first spring and a count, which follow it through sorting.
class SpringsInPlace {
 public:
  virtual ~SpringsInPlace() = default;

  // Makes room for n spheres; new ones have no springs.
  virtual void grow(int n) = 0;
  virtual int *first() = 0;
  virtual int *count() = 0;

  // Packs spheres that leave the process, as a host on a GPU lays out its messages: first the offset of each sphere's
  // numbers, as an integer in a double, then for each sphere its count of springs and its springs. Sphere which[k] leaves, and
  // sphere from[k], if that is not -1, takes its place. Returns how many numbers it wrote.
  virtual int largest_packed_size(int n) = 0;    // numbers of one of n spheres; waits
  virtual int most_packed_size() const = 0;      // that one can have
  virtual int pack(int n, const int *which, const int *from, double *buffer) = 0;
  // Unpacks spheres that came: sphere to[k], if that is not -1, gets the k-th. From n_first on offsets are those of a second
  // message, which begins at `second`.
  virtual void unpack(int n, const int *to, const double *buffer, int n_first, int second) = 0;
};

class NodesInPlace;         // engine/nodes_in_place.h
struct NodeGridSettings;    // grid/build/node_grid.h

// Computes wall forces for the spheres of one process: in every step begin(), choose_if_due(), submit() and
// collect(). Springs stay with the engine between steps and follow the spheres'
// indices; a host that moves spheres takes them out before (springs_to) and gives them back.
class WallEngine {
 public:
  virtual ~WallEngine() = default;

  // Returns the backend in words, for the log: "CPU, 4 threads" or "CUDA, NVIDIA H200".
  virtual std::string backend() const = 0;

  // Sets the grid of a mesh, to use from now on; it is borrowed, and must outlive its use. The next choose_if_due() chooses.
  // Steps read lists of the wall's own records, packed where they are complete; other grids are for queries.
  void set_grid(const GridView &grid, int mesh = 0)
  {
    if (grid.in_floats ||
        (grid.list_kind.is_complete() && grid.lists.entries && !grid.lists.is_packed()))
      throw std::logic_error("a grid for queries cannot serve steps: build it without in_floats, "
                             "and not as ListForm::full");
    expire_choice();
    put_grid(grid, mesh);
  }

  // Sets the pose and velocity of a mesh from now on. At first a mesh is in the frame of its grid. Must not be called between submit()
  // and collect(), and only for engines whose settings say that the wall moves.
  virtual void set_pose(const Pose &pose, int mesh = 0) = 0;

  // Returns the largest radius of the group (length).
  virtual Real largest_radius(const Spheres &spheres) = 0;
  // Returns how far the spheres of the group are past periodic faces at most (length).
  virtual Real farthest_past(const Spheres &spheres, const PeriodicFaces &faces) = 0;

  // Chooses the candidate spheres of the next steps, the broad phase: those of the group that could touch the wall after moving
  // by up to `margin` (length) relative to it. Makes their neighbour lists. Radii must not grow until the next choice: a candidate
  // that grows is an error, and another sphere that grows is missed until then. With `watch` has_moved() may be asked. Throws
  // InputError with index and radius if a sphere is larger than the grid's cutoff.
  virtual void choose(const Spheres &spheres, Real margin, bool watch = false) = 0;

  // Returns whether a sphere that could touch the wall where it is now has moved, relative to the wall, by more than the margin
  // of the last choice. Spheres that cannot touch it may have gone any distance.
  virtual bool has_moved(const Spheres &spheres) = 0;

  // Begins a step, which does its work `when` it says: what it reads of spheres is final, in place once the host's stream has
  // done its work. Until collect() the host must not change x, v, omega or radii, and may change force and torque. A step that
  // was begun before and not collected is dropped.
  virtual void begin(When when = When::in_turn) = 0;

  // Chooses spheres where the last choice does not hold for this step any more, which the engine knows from how far spheres
  // and meshes have gone. `moving`: the meshes that move, always in the same order. Returns whether it has chosen. Throws as
  // choose(); the step stays begun.
  bool choose_if_due(const Spheres &spheres, const SphereDrift &drift,
                     const std::vector<MovingMesh> &moving);
  // Makes the next choose_if_due() choose, however little has moved.
  void expire_choice() { schedule_.expire(); }

  // Gives the step its spheres and settings, and starts its work where something else than this thread does it.
  virtual void submit(const Spheres &spheres, const StepSettings &step) = 0;

  // Returns after submit() whether the work goes on by itself, so that collect() only waits for it.
  virtual bool is_under_way() const = 0;

  // Adds forces and torques, does the work before where nothing else does it, and replaces the springs (unless update_history is
  // false) and the totals, which are those of the last step until then.
  virtual void collect() = 0;

  StepState state() const { return state_; }

  // Does a whole step in turn: begin(), submit() and collect().
  void step(const Spheres &spheres, const StepSettings &step)
  {
    begin();
    submit(spheres, step);
    collect();
  }

  // Returns the totals of the last step on this process.
  virtual const WallTotals &totals() const = 0;
  // Returns the totals of one mesh, without largest_overlap_sphere.
  virtual WallTotals mesh_totals(int mesh) const = 0;

  // The spheres with a contact in the last step: their number, indices and outputs.
  // Valid after collect() of a step with per_sphere.
  virtual int n_touching() const = 0;
  virtual const int *touching() const = 0;
  virtual const SphereOutput *sphere_output() const = 0;
  // Returns the states of these spheres, after a step with `states`.
  virtual const TouchingSphere *touching_spheres() const = 0;
  // Returns the power into each of these spheres; null where the law has no heat.
  virtual const Real *sphere_heat() const = 0;

  // Records of the contacts of the last step, in the order of the spheres;
  // valid after collect() where settings.contacts and step.contacts are set.
  virtual int n_contacts() const = 0;
  virtual const StepContact *contacts() const = 0;

  // Returns what steps have counted since the last call, and counts anew. Throws InputError if a step had to leave out a sphere
  // that is too large or has more contacts than there is memory for, or if one grew after the choice.
  virtual StepDiagnostics read_diagnostics() = 0;

  // The following is for meshes whose nodes move, where the settings have nodes.

  // Returns the nodes in the engine's own memory, where it has copies of the records of meshes, as on a GPU; else null.
  virtual NodesInPlace *nodes_in_place() { return nullptr; }
  // Builds the grid of a mesh from where its nodes are now, to use from now on, by grid/build/node_grid.h, in an engine with
  // nodes_in_place(). The next choose_if_due() chooses.
  void build_node_grid(int mesh, const NodeGridSettings &settings)
  {
    expire_choice();
    build_grid_of_nodes(mesh, settings);
  }
  // Turns the springs of the spheres [0, n) on a mesh with their features, before a step, in the frame of the mesh. An engine with
  // nodes_in_place() knows where nodes were before, and reads nothing of `turning`.
  virtual void turn_springs(int n, int mesh, const TurningMesh &turning) = 0;
  // The forces of the contacts of the last step on the nodes of a mesh, in fixed point. step.contacts need not be set. An
  // engine with nodes_in_place() reads nothing of `now` and `wall`. All follow each other after a step: what they read of
  // spheres and nodes is as in collect().
  //
  // Sees the contacts on this process. Does not wait.
  virtual void see_node_forces(int mesh, const NodesNow &now, const MeshFeaturesView &wall) = 0;
  // Returns the range of what was seen. Waits.
  virtual NodeForceRange node_force_range(int mesh) = 0;
  // Adds up what was seen, in units of the range of all processes, or of this one's own where it is null. Does not wait.
  virtual void add_node_forces(int mesh, const NodeForceRange *of_all) = 0;
  // Copies the sums in units of SumUnit(range.shares), x y z, node after node, if `sums` is not null; none are made
  // where a force is not finite. Returns the power of the nodes on the spheres. Waits.
  virtual Real fetch_node_forces(int mesh, std::int64_t *sums) = 0;

  // Copy the springs of the spheres [0, n) from the engine and to it.
  virtual void springs_to(ContactHistory &store, int n) = 0;
  virtual void springs_from(const ContactHistory &store, int n) = 0;
  // Returns the springs where spheres are in the memory of the engine's backend, or null where a host hands spheres over.
  virtual SpringsInPlace *springs_in_place() { return nullptr; }

  // Returns how many candidates the last choice left.
  virtual int n_candidates() const = 0;
  // Returns the bytes of memory that the engine uses where it computes.
  virtual std::size_t bytes() const = 0;

 protected:
  void require(StepState state) const
  {
    if (state_ != state)
      throw std::logic_error("a step is begun, submitted and collected, in this order");
  }
  // Do the work of set_grid() and build_node_grid(), which have asked for a choice.
  virtual void put_grid(const GridView &grid, int mesh) = 0;
  virtual void build_grid_of_nodes(int mesh, const NodeGridSettings &settings) = 0;

  StepState state_ = StepState::none;

 private:
  CandidateSchedule schedule_;
};

// Does one step, from a choice of its own, for a host that keeps the springs itself. `springs` may be null where the law has no
// history.
void step_once(WallEngine &engine, const Spheres &spheres, const StepSettings &step,
               ContactHistory *springs);

// For a host whose arrays are in its own memory. Device::cuda without a GPU throws InputError;
// Device::automatic takes the CPU then.
std::unique_ptr<WallEngine> make_engine(const EngineSettings &settings);

// For particles that live where the engine computes, in the memory of the CPU, or of a GPU: `device` holds them,
// `stream` is a cudaStream_t of it. Pointers in Spheres are to that memory, so that a step copies nothing and waits
// for nothing, and collect() fetches what the step's settings ask for. The latter throws InputError in a build
// without CUDA.
std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings);
std::unique_ptr<WallEngine> make_cuda_engine_in_place(const EngineSettings &settings, int device,
                                                      void *stream);

}    // namespace lsdcd
