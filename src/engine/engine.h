// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The interface between a host (the wall, the tool, tests, benches) and the engines.
#pragma once

#include "backend/cuda_available.h"
#include "box/periodic_box.h"
#include "engine/candidate_schedule.h"
#include "engine/grains.h"
#include "engine/resident_rows.h"
#include "engine/results/step_results.h"
#include "engine/settings.h"
#include "grid/triangle_grid.h"
#include "motion/pose.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

// The state of a step, which is first begun, then submitted, then collected.
enum class StepState { none, begun, submitted };

class NodeEngine;    // engine/nodes/node_engine.h
template <class Row>
class FeatureEngine;    // engine/loads/feature_engine.h
struct Load;            // engine/loads/load.h
class EnergyEngine;     // engine/loads/energy_engine.h
class TriangleTree;     // tree/triangle_tree.h

// Computes wall forces for the spheres of one process. The host calls begin(), choose_if_due(), submit() and collect() in every step.
// Springs stay in the engine between steps and follow the spheres' indices; a host that moves spheres takes the springs out before and
// gives them back afterwards.
class WallEngine {
 public:
  virtual ~WallEngine() = default;

  // Returns the backend in words, for the log: "CPU, 4 threads" or "CUDA, NVIDIA H200".
  virtual std::string backend() const = 0;

  // Sets the grid of a mesh from now on. The grid is borrowed, and must outlive its use. The next choose_if_due() searches for candidates.
  void set_grid(const ViewOf<StepGrid> &grid, int mesh = 0)
  {
    expire_choice();
    put_grid(grid, mesh);
  }

  // Sets the tree of the triangles of a mesh's grid, which steps read if laws are for shapes. It is borrowed, and must outlive its use.
  virtual void set_tree(const TriangleTree &tree, int mesh = 0);

  // Sets the pose and velocity of a mesh from now on. Initially a mesh is in the frame of its grid. Must not be called between submit()
  // and collect(), and only for engines whose settings say that the wall moves.
  virtual void set_pose(const Pose &pose, int mesh = 0) = 0;

  // Returns the largest radius of the group (length).
  virtual Real largest_radius(const Spheres &spheres) = 0;
  // Returns how far the spheres of the group are past periodic faces, at most (length).
  virtual Real farthest_past(const Spheres &spheres, const PeriodicFaces &faces) = 0;

  // Searches for the candidate spheres of the next steps, which is the broad phase: those of the group that could touch the wall after
  // moving by up to `margin` (length) relative to it. Makes their neighbour lists. Radii must not grow until the next search: a candidate
  // that grows is an error, and another sphere that grows is missed until then. With `watch`, has_moved() may be called. Throws InputError
  // with index and radius if a sphere is larger than the grid's cutoff.
  virtual void choose(const Spheres &spheres, Real margin, bool watch = false) = 0;

  // Returns whether a sphere that could touch the wall where it is now has moved, relative to the wall, by more than the margin of the
  // last candidate search. Spheres that cannot touch the wall may have moved any distance.
  virtual bool has_moved(const Spheres &spheres) = 0;

  // Begins a step, which does its work when `when` says. From now on until collect() the host must not change x, v, omega or radii. In
  // place on a GPU the host's stream may still be writing them, and the step waits for it. Force and torque may change. A previous step
  // that was begun and not collected is dropped; if its work had begun, its springs have moved.
  virtual void begin(When when = When::in_turn) = 0;

  // Searches for candidates if those of the last search are no longer valid for this step. The engine decides this by how far spheres and
  // meshes have moved. `moving`: the meshes that move, always in the same order. Returns whether it has searched. Throws as choose() does;
  // the step stays begun.
  bool choose_if_due(const Spheres &spheres, const SphereDrift &drift,
                     const std::vector<MovingMesh> &moving);
  // Makes the next choose_if_due() search for candidates, however little has moved.
  void expire_choice() { schedule_.expire(); }

  // Gives the step its spheres and settings, and starts its work if something other than this thread does it.
  virtual void submit(const Spheres &spheres, const StepSettings &step) = 0;

  // Returns, after submit(), whether the work runs by itself, so that collect() only waits for it.
  virtual bool is_under_way() const = 0;

  // Adds forces and torques, after doing the work if nothing else does it. Replaces the springs (unless update_history is false) and the
  // totals, which until then are those of the last step.
  virtual void collect() = 0;

  StepState state() const { return state_; }

  // Does a whole step: begin(), submit() and collect().
  void step(const Spheres &spheres, const StepSettings &step)
  {
    begin();
    submit(spheres, step);
    collect();
  }

  // Returns the results of the last step.
  virtual StepResults &results() = 0;
  // Returns the overlap (length) of a contact in the last step. `pose`: that of its mesh in that step.
  virtual Real overlap(const TouchingSphere &of, const StepContact &contact, const Pose &pose)
  {
    return of.radius - norm(pose.turn_to_box(contact.arm));
  }
  // Returns the springs of the spheres, which steps read and replace.
  virtual ResidentRows &springs() = 0;
  // Returns the engine for the nodes of a mesh; null if the settings have no nodes.
  virtual NodeEngine *nodes(int /* mesh */) { return nullptr; }
  // Takes the nodes of all meshes, and the forces on them, from another engine on the same backend, instead of starting them. The objects
  // that nodes() of that engine has returned belong to this engine from now on. Grids have to be built.
  virtual void take_nodes(WallEngine & /* from */) {}
  // Returns the object that adds up loads of features in the memory of the engine; null if the host reads contacts as fast.
  virtual FeatureEngine<Load> *loads() { return nullptr; }
  // Returns the object that adds up energy of features in the memory of the engine, if the settings record energy.
  virtual EnergyEngine *energies() { return nullptr; }

  // Returns what steps have counted since the last call, and resets the counts to 0. Throws InputError if a step had to leave out a sphere
  // that is too large or has more contacts than there is memory for, or if a sphere has grown after the candidate search.
  virtual StepDiagnostics read_diagnostics() = 0;

  // Returns the number of candidates that the last search found.
  virtual int n_candidates() const = 0;
  // Returns the bytes that the engine uses in the memory of its backend.
  virtual std::size_t bytes() const = 0;

 protected:
  void require(StepState state) const
  {
    if (state_ != state)
      throw std::logic_error("a step is begun, submitted and collected, in this order");
  }
  // Does the work of set_grid(), which has already made a candidate search due.
  virtual void put_grid(const ViewOf<StepGrid> &grid, int mesh) = 0;

  StepState state_ = StepState::none;

 private:
  CandidateSchedule schedule_;
};

// Does one step, including a candidate search, for a host that keeps the springs itself. `springs` may be null if the law has no history.
void step_once(WallEngine &engine, const Spheres &spheres, const StepSettings &step,
               KeptRows *springs);

// Makes an engine for a host whose arrays are in its own memory. Device::cuda without a GPU throws InputError; Device::automatic then
// takes the CPU.
std::unique_ptr<WallEngine> make_engine(const EngineSettings &settings);

// Make an engine for particles in the memory of the engine's backend: of the CPU, or of a GPU, where `device` holds them and `stream` is
// one of its cudaStream_t. Pointers in Spheres are to that memory, so that a step copies nothing and waits for nothing; only collect()
// fetches what the step's settings ask for. make_cuda_engine_in_place() throws InputError in a build without CUDA.
std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings);
std::unique_ptr<WallEngine> make_cuda_engine_in_place(const EngineSettings &settings, int device,
                                                      void *stream);

}    // namespace lsdcd
