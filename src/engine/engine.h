// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The interface between a host (the wall, the tool, tests, benches) and the engines.
#pragma once

#include "backend/cuda_available.h"
#include "box/periodic_box.h"
#include "contact/contact_history.h"
#include "engine/candidate_schedule.h"
#include "engine/grains.h"
#include "engine/results/step_results.h"
#include "engine/settings.h"
#include "engine/springs.h"
#include "grid/triangle_grid.h"
#include "motion/pose.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace lsdcd {

// A step is begun, submitted and collected.
enum class StepState { none, begun, submitted };

class NodeEngine;      // engine/nodes/node_engine.h
class LoadEngine;      // engine/loads/load_engine.h
class EnergyEngine;    // engine/loads/energy_engine.h
class TriangleTree;    // tree/triangle_tree.h

// Computes wall forces for the spheres of one process: in every step begin(), choose_if_due(), submit() and
// collect(). Springs stay with the engine between steps and follow the spheres'
// indices; a host that moves spheres takes them out before and gives them back.
class WallEngine {
 public:
  virtual ~WallEngine() = default;

  // Returns the backend in words, for the log: "CPU, 4 threads" or "CUDA, NVIDIA H200".
  virtual std::string backend() const = 0;

  // Sets the grid of a mesh, to use from now on; it is borrowed, and must outlive its use. The next choose_if_due() chooses.
  void set_grid(const ViewOf<StepGrid> &grid, int mesh = 0)
  {
    expire_choice();
    put_grid(grid, mesh);
  }

  // Sets the tree of the triangles of a mesh's grid, which steps read where laws are for shapes. It is borrowed, and must outlive its use.
  virtual void set_tree(const TriangleTree &tree, int mesh = 0);

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

  // Begins a step, which does its work `when` it says. From now on until collect() the host must not change x, v, omega or radii;
  // in place on a GPU its stream may still be writing them, and the step waits for it. Force and torque may change. A step that
  // was begun before and not collected is dropped; where its work had begun its springs have moved.
  virtual void begin(When when = When::in_turn) = 0;

  // Chooses spheres where the last choice does not hold for this step, which the engine knows from how far spheres
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

  // Returns what the last step left.
  virtual StepResults &results() = 0;
  // Returns the overlap (length) that a contact of the last step had. `pose`: of its mesh in that step.
  virtual Real overlap(const TouchingSphere &of, const StepContact &contact, const Pose &pose)
  {
    return of.radius - norm(pose.turn_to_box(contact.arm));
  }
  // Returns the springs of the spheres, which steps read and replace.
  virtual Springs &springs() = 0;
  // Returns what it does for the nodes of a mesh; null where the settings have no nodes.
  virtual NodeEngine *nodes(int /* mesh */) { return nullptr; }
  // Takes the nodes of all meshes, and the forces on them, from another engine on the same backend, in place of starting them: what
  // nodes() has returned there belongs to this one from now on. Grids are to be built.
  virtual void take_nodes(WallEngine & /* from */) {}
  // Returns what adds up loads of features where it computes; null where the host reads contacts as fast.
  virtual LoadEngine *loads() { return nullptr; }
  // Likewise what becomes of energy, where the settings record it.
  virtual EnergyEngine *energies() { return nullptr; }

  // Returns what steps have counted since the last call, and counts from 0 again. Throws InputError if a step had to leave out a sphere
  // that is too large or has more contacts than there is memory for, or if one grew after the choice.
  virtual StepDiagnostics read_diagnostics() = 0;

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
  // Does the work of set_grid(), which has asked for a choice.
  virtual void put_grid(const ViewOf<StepGrid> &grid, int mesh) = 0;

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
