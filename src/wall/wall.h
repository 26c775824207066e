// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall of meshes that any program can step: it finds the contacts of spheres, and gives each sphere
// its force and torque.
#pragma once

#include "base/input_error.h"
#include "wall/checks/overlap_monitor.h"
#include "wall/checks/snapshot_check.h"
#include "wall/checks/timestep_check.h"
#include "wall/coat/body_coats.h"
#include "wall/device_choice.h"
#include "wall/engine_input.h"
#include "wall/grid_manager.h"
#include "wall/reports/contact_rows.h"
#include "wall/reports/search_report.h"
#include "wall/spheres/host_spheres.h"
#include "wall/state_keeper.h"
#include "wall/sums/energy_books.h"
#include "wall/sums/energy_recorder.h"
#include "wall/sums/load_recorder.h"
#include "wall/sums/mean_loads.h"
#include "wall/sums/step_totals.h"
#include "wall/surface/node_meshes.h"
#include "wall/wall_files.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsdcd {

// Where a wall computes.
struct WallBackend {
  // Makes its engine. Throws InputError where there is none for these settings.
  std::function<std::unique_ptr<WallEngine>(const EngineSettings &)> make_engine =
      lsdcd::make_engine;
  bool in_place = false;    // spheres are in the memory of its backend
  ToCpu to_cpu;             // where that is a GPU's
};

// The host's units.
struct WallUnits {
  Real pressure = 1;    // a force per area of 1, in the unit of pressure
  Real velocity = 1;    // a force times time over a mass, in the unit of velocity
};

// In each step: begin(), submit(), finish(). Places, velocities and radii must not change between begin()
// and finish(); forces and torques may.
//
// Spheres are counted from 0, meshes too. Functions are collective, so that all processes call them, but for those
// that say that they are local. Errors are InputError; those of one process alone are local.
class Wall {
 public:
  // Reads the meshes, makes the engine, and logs what there is. `material`: what a material file filled in,
  // for the log. `clock`: the time of the host. `there`: the spheres that there are, in memory of the CPU. The host
  // must outlive the wall. Throws InputError where the spec makes no sense.
  Wall(Host &host, WallSpec spec, const WallUnits &units, WallBackend backend,
       const std::string &material, const StepClock &clock, const HostSpheres &there = {});

  // Local:
  const WallSpec &spec() const { return spec_; }    // pressures are forces per area
  const LawTable &laws() const { return laws_; }
  const std::deque<MeshPart> &meshes() const { return meshes_; }
  // Those of spec().inputs whose values a step reads, by their numbers: of motions first, then temperatures.
  std::vector<int> inputs_read() const;
  Real cutoff() const { return grids_.cutoff(); }    // length; 0: there were no spheres yet
  HistoryExchange &history() { return history_; }
  std::size_t bytes() const;    // of this process

  // Before each run. `virial`: add_virial() may be called in it.
  void begin_run(std::int64_t step, bool virial);

  // Begins a step: advances the clock, moves the meshes, and builds grids where they do not fit. Where spheres are in
  // the memory of a GPU, what the step reads of them must be there once the host's stream has done its work so far. What one of several
  // processes cannot do alone finish() throws there, once all have come to it.
  void begin(const HostSpheres &spheres, const StepInput &input);
  // Moves the vertices of meshes that change by themselves, as by wear, where that is due in this step. A host that reads the surface before begin()
  // calls it; otherwise begin() does.
  void change_surfaces(const Step &step);
  // Chooses the spheres near the wall where that is due, and starts the step where the engine can work beside the host.
  // Local.
  void submit(const HostSpheres &spheres);
  // Returns how far the step is. StepState::none means that no step was begun, or one without spheres. Local.
  StepState step_state() const { return engine_->state(); }
  // Adds forces and torques to those of the spheres, and submits the step before if nobody has.
  void finish(const HostSpheres &spheres);

  // Sets all totals to 0, because the wall acts on nothing until the next step. Local.
  void clear_totals();
  // Reads what steps have noted of these spheres since the last call. Must be called before spheres change their order or
  // process, because notes name spheres by their index. Throws where a step had to leave out a sphere. Local.
  void poll_diagnostics(const HostSpheres &spheres);
  // Returns the deepest overlap (length) that was read on this process since begin_run(), of a host with arrays in float.
  Real deepest_overlap() const { return deepest_overlap_; }
  // Warns where spheres went too far past a periodic face. Hosts that do not know how far spheres go call it before they wrap
  // them. Positions and groups are read in the memory in which the engine reads them.
  void check_wrapping(const Spheres &spheres) { grids_.check_wrapping(spheres); }
  // Ends a run: logs how it went. `advice` follows the number of choices in the log; `loop` is the run's time in seconds, or 0
  // if it is not known.
  void end_run(const HostSpheres &spheres, bool far, const std::string &advice, Real loop);

  // Returns the totals of the last step, summed over all processes.
  const StepTotals &totals();
  // Returns them with the power of nodes by the velocities of the whole step, which they have now, where the host knows these. After
  // the end of a run the power stays.
  const StepTotals &totals_with_power();
  MeanLoads &means() { return means_; }        // of spec().average_every steps
  EnergyBooks &energy() { return energy_; }    // of a wall with spec().energy
  // Returns the spectrum of the impacts on a mesh, of a wall with spec().impact_speed.
  ImpactSpectrum impacts(int mesh) { return records_.spectrum(mesh); }
  // Return the volume by which wear has moved a mesh back, and the volume that is worn but held back, see MeshWear. 0 of others.
  Real removed(int mesh) const { return meshes_[mesh].surface->removed(); }
  Real held_back(int mesh) const { return meshes_[mesh].surface->held_back(); }
  Real worn(int mesh) { return spec_.wears() ? loads_.worn(mesh) : 0; }    // volume
  // Returns the force, or the torque, of the mesh on the spheres along the axis of its servo.
  Real servo_push(int mesh);
  // Returns the body that a mesh is, with velocities of the whole step, or null if it is none.
  const BodyMover *body(int mesh);
  MeshNodes &nodes(int mesh) { return *meshes_[mesh].nodes(); }    // of a mesh that has_nodes
  // Returns the forces of the last step on the nodes of a mesh that has_nodes, x y z, node after node: those of contacts and of
  // its pressure, summed over all processes.
  const std::vector<Real> &node_forces(int mesh);
  // Writes this process's share of node_forces() to `to`, which lies where the wall computes, as MeshNodes::put_forces() says.
  // Local.
  bool put_node_forces(int mesh, Real *to, const std::vector<int> &node_of_row);
  // Adds the sum of arm times force over the contacts of this process, an energy, to six numbers: xx, yy, zz, xy, xz, yz. Local.
  void add_virial(Real *virial) const;
  // Calls row(sphere, numbers) for each sphere of this process with a contact, with the
  // spec().contact_columns() numbers of the contacts array. Local.
  void for_contact_rows(const std::function<void(int, const Real *)> &row) const;

  // Calls found(contact) for each contact of the last step of this process, where spec().each_contact, sphere after
  // sphere; where spec().energy then for those that the step has ended. Local.
  void for_contacts(const std::function<void(const WallContact &)> &found) const;

  // Writes the files that are due in this step.
  void write_due_files();
  int files_every() const { return files_.every(); }    // steps; 0: there are none. Local.

  // The following are called between steps. Where they throw InputError, nothing has changed.

  // Sets the names of inputs, which begin with those that there are.
  void set_inputs(const InputNames &inputs);
  // Returns why this mesh takes no motion, servo or pose, or an empty text if it takes them. Local.
  std::string why_it_takes_no_motion(int mesh) const { return meshes_[mesh].mover.why_no_motion(); }
  // Moves a mesh by another motion from where it is, or stops it by a motion without terms. Its servo goes on; the servo of
  // `motion` is not read.
  void set_motion(int mesh, const RigidMotion &motion, const Step &now);
  // Moves a mesh by another servo from where it is, or takes its servo away by one that is not present. A servo along the
  // same line goes on from the position that the last one had.
  void set_servo(int mesh, const Servo &servo);
  // Sets what holds and drives a mesh that is a body: joint, spring, limits, motor, load, moment and gravity of `to`, from
  // where the body is, without a jump. With another joint its coordinate begins at 0 there, and what the joint allows
  // of its velocity goes on. The rest of `to` is not looked at.
  void set_body(int mesh, const BodySpec &to);
  // Throws InputError where it is none. Local.
  void check_is_body(int mesh) const;
  // Sets the pose, for the next step and those after it, of a mesh whose motion is_posed(), and that is no body and has no
  // nodes. Local.
  void set_pose(int mesh, const Pose &pose) { meshes_[mesh].mover.set_pose(pose); }
  // Sets places (length) and velocities (length/time) of the nodes of a mesh that has_nodes, x y z, node after node, for the
  // next step and those after it. Velocities are of the same time as those of spheres, or all 0 where `v` is null. All
  // processes give the same numbers. Local.
  void set_nodes(int mesh, const Real *x, const Real *v) { nodes(mesh).set(x, v); }
  // Sets places and velocities of nodes from arrays that lie where the wall computes, as MeshNodes::set_in_place() says.
  void set_nodes_in_place(int mesh, const Real *x, const Real *v,
                          const std::vector<int> &node_of_row)
  {
    nodes(mesh).set_in_place(x, v, node_of_row);
  }

  // Writes the history of a sphere for a saved state, with names of features that hold in any run. Returns how many numbers it
  // wrote. Local.
  int pack_saved(int sphere, Real *buffer);
  // Returns what the wall keeps beside the histories of spheres, for a saved state. The loads of all processes are on the first
  // one alone.
  WallState save();
  bool has_begun() const { return has_begun_; }    // a step. Local.
  // Throws InputError where the first step could not begin, as it is of bodies outside of their limits. Local.
  void check_start() const
  {
    for (const MeshPart &m : meshes_) m.mover.check_start();
  }
  // Keeps what the wall was made as until the first step, for a host that may call restore() more than once. It takes as much
  // memory as a saved state, on each process.
  void keep_made();
  // Restores what another wall has saved, before the first step; all processes give the same state. Throws InputError, with
  // nothing changed, where a servo or a body would be outside of its limits.
  void restore(const WallState &was, const Step &now);
  // Restores the history of the spheres of this process after restore(), each as pack_saved() wrote it. Warns of what does not
  // fit.
  void restore_springs(const std::vector<std::vector<Real>> &spheres);

 private:
  EngineSettings engine_settings() const
  {
    return engine_input_.settings(device_.device(), virial_, !bodies_.empty());
  }
  void make_engine();
  void settle(const HostSpheres &spheres, const StepInput &input);
  void open_step(const HostSpheres &spheres, const StepInput &input);
  void log_creation(const std::string &material, const WallBackend &backend) const;
  std::string named(const MeshPart &m, const std::string &text) const;
  SpheresOnCpu on_cpu(const HostSpheres &spheres) const
  {
    return SpheresOnCpu(spheres, backend_.to_cpu);
  }
  template <class Work>
  void guard(const HostSpheres &spheres, Work &&work);
  InputError failure_here(const HostSpheres &spheres) const;

  void check_history(int n);
  const StepTotals &sums();
  Real most_candidates();
  void log_device(Real near);
  void move(const HostSpheres &spheres);
  void place_grids(const HostSpheres &spheres);
  void look_at_spheres(const HostSpheres &spheres);
  void look_at_new_spheres(const HostSpheres &spheres);
  void look_at_range(const HostSpheres &spheres);
  ServoLoad servo_load(int mesh);
  void complete_bodies();
  Touch touch(const MeshPart &m);    // in the last step
  StepSettings step_settings();
  void collect(int n);
  StepResults *results() const;
  void note_poses();
  std::vector<NodeLoad> node_loads();
  void note_step(const HostSpheres &spheres);
  void note_energy_records(const MeshPart &m, StepResults *left);
  Real pressure(int mesh) const;    // in this step, in units of forces

  void choose_if_due(const Spheres &spheres);
  void log_new_springs(const Step &step);
  StepDiagnostics read_diagnostics(const HostSpheres &spheres);
  void check_new_spheres(const HostSpheres &spheres);

  void log_change(const MeshPart &m, const std::string &text);
  void list_meshes();
  void note_mobility(const MeshPart &m);
  void mover_has_changed(const MeshPart &m);

  Host &host_;
  WallSpec spec_;    // motions change later
  LawTable laws_;    // of the spec
  WallBackend backend_;
  // The time of the spheres; the host's time begins again in some runs from a saved state.
  StepClock clock_;
  Real pressure_unit_;             // of inputs
  std::deque<MeshPart> meshes_;    // where each stays; there is one at least
  // Lists of them, in their order: who has nothing to do in a step is in none. Those that are, or may be, where their file does not
  // have them; of these, and of those whose surface varies, those that may move in the next step; whose own shape changes; that are
  // bodies; that have a servo; whose loads are recorded. Those whose nodes move, which stay the same.
  std::vector<MeshPart *> placed_, moving_, changing_, bodies_, servos_, recorded_,
      with_energy_records_;
  std::vector<MeshNodes *> with_nodes_;
  EngineInput engine_input_;
  BodyCoats coats_;
  DeviceChoice device_;
  bool is_set_up_ = false;    // the last step set a run up
  std::unique_ptr<WallEngine> engine_;
  bool engine_moves_ = false, engine_contacts_ = false;    // what its laws are compiled for
  bool reads_loads_ = false;    // are contacts read in each step for loads or wear?
  bool virial_ = false;         // may be asked for in this run

  HistoryExchange history_;
  StepTotals totals_;
  MeanLoads means_;
  LoadRecorder loads_;
  EnergyBooks energy_;
  EnergyRecorder records_;
  WallFiles files_;
  OverlapMonitor overlaps_;
  SearchReport search_;
  Real deepest_overlap_ = 0;
  TimeReport times_;
  TimestepCheck timestep_;
  SnapshotCheck snapshots_;
  BoxChecks box_checks_;
  GridManager grids_;
  StateKeeper keeper_;

  StepInput input_;                           // of the last begin()
  std::vector<std::vector<Vec3>> receded_;    // see StepSettings; empty: no mesh has moved so
  std::vector<Pose> poses_;                   // of the meshes in the last step that was finished
  bool has_begun_ = false;                    // a step
  bool is_running_ = false;                   // a step, and no run has ended since
  std::optional<InputError> failure_;    // of the last step on this process, where there are others
  bool continued_ = false;               // from a saved state
  bool springs_told_ = false;
  bool points_warned_ = false;
  SphereRange range_;    // for gains of servos and the timestep of bodies
  bool range_is_known_ = false;
  Real largest_within_ =
      0;    // radius of the largest ball in a grain, when they were looked at last (length)
};

}    // namespace lsdcd
