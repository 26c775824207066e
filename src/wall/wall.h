// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall of meshes that any program can step: it finds the contacts of spheres, and adds the wall's force and torque to each sphere.
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
  // Makes the engine of the wall. Throws InputError if no engine exists for these settings.
  std::function<std::unique_ptr<WallEngine>(const EngineSettings &)> make_engine =
      lsdcd::make_engine;
  bool in_place = false;    // spheres are in the memory of its backend
  ToCpu to_cpu;             // if that is the memory of a GPU
};

// The host's units.
struct WallUnits {
  Real pressure = 1;    // how many units of pressure a force per area of 1 is
  Real velocity = 1;    // a force times time over a mass, in the unit of velocity
};

// The program calls begin(), submit() and finish() in each step. Places, velocities and radii must not change between begin() and finish();
// forces and torques may.
//
// Spheres and meshes are counted from 0. All functions are collective, which means that all processes call them, unless their comment says
// that they are local. Errors are InputError; an error of a single process is local.
class Wall {
 public:
  // Reads the meshes, makes the engine, and logs the wall. `material`: what a material file has filled in, for the log. `clock`: the time
  // of the host. `there`: the spheres that exist now, in memory of the CPU. The host must outlive the wall. Throws InputError if the spec
  // makes no sense.
  Wall(Host &host, WallSpec spec, const WallUnits &units, WallBackend backend,
       const std::string &material, const StepClock &clock, const HostSpheres &there = {});

  // spec() to bytes() are local.
  const WallSpec &spec() const { return spec_; }    // pressures are forces per area
  const LawTable &laws() const { return laws_; }
  const std::deque<MeshPart> &meshes() const { return meshes_; }
  // Returns which of spec().inputs a step reads, by their numbers: those of motions, then of temperatures, then of pressures.
  std::vector<int> inputs_read() const;
  Real cutoff() const { return grids_.cutoff(); }    // length; 0: there were no spheres yet
  HistoryExchange &history() { return history_; }
  std::size_t bytes() const;    // memory of this process

  // Prepares for a run; called before each one. `virial`: add_virial() may be called in that run, so that its steps keep what it needs.
  void begin_run(std::int64_t step, bool virial);

  // Begins a step: advances the clock, moves the meshes, and rebuilds grids that no longer fit. If spheres are in the memory of a GPU, work
  // that is in the host's stream now may still write their arrays, and the step waits for that work. It does not wait for work that the
  // host puts into the stream later. If there are several processes and one of them fails, finish() throws its error later, after all processes have reached it.
  void begin(const HostSpheres &spheres, const StepInput &input);
  // Moves the vertices of meshes that change by themselves, as by wear, if this is due in this step. A host that reads the surface before
  // begin() calls this function first; otherwise begin() does.
  void change_surfaces(const Step &step);
  // Searches for the candidates, the spheres near the wall, if a search is due, and starts the step if the engine can work while the host
  // does. Local.
  void submit(const HostSpheres &spheres);
  // Returns how far the step has come. StepState::none means that no step was begun, or that the step has no spheres. Local.
  StepState step_state() const { return engine_->state(); }
  // Adds forces and torques to those of the spheres. Submits the step first if the host has not done so.
  void finish(const HostSpheres &spheres);

  // Sets all totals to 0, because the wall acts on nothing until the next step. Local.
  void clear_totals();
  // Reads what steps have noted about these spheres since the last call. Must be called before spheres change their order or process,
  // because notes name spheres by their index. Throws InputError if a step had to leave out a sphere. Local.
  void poll_diagnostics(const HostSpheres &spheres);
  // Returns the deepest overlap (length) that this process has read since begin_run(), if the host has its arrays in
  // float; 0 otherwise. Local.
  Real deepest_overlap() const { return deepest_overlap_; }
  // Warns if spheres went too far past a periodic face. A host that does not know how far spheres move calls it before it wraps them.
  // Positions and groups are read in the memory in which the engine reads them.
  void check_wrapping(const Spheres &spheres) { grids_.check_wrapping(spheres); }
  // Ends a run and logs a summary. In the log `advice` follows the number of candidate searches. `loop`: the time of the run in seconds, or
  // 0 if it is not known. `far`: spheres may have gone far, so that check_wrapping() is due.
  void end_run(const HostSpheres &spheres, bool far, const std::string &advice, Real loop);

  // Returns the totals of the last step, summed over all processes.
  const StepTotals &totals();
  // Returns the totals with the power of nodes computed from velocities of the whole step, if the host knows these now. After the end of a
  // run the power stays as it was.
  const StepTotals &totals_with_power();
  MeanLoads &means() { return means_; }        // of spec().average_every steps
  EnergyBooks &energy() { return energy_; }    // of a wall with spec().energy
  // Returns the spectrum of the impacts on a mesh, for a wall with spec().impact_speed.
  ImpactSpectrum impacts(int mesh) { return records_.spectrum(mesh); }
  // Return the volume by which wear has moved a mesh back, and the volume that is worn but held back (see MeshWear). 0 for meshes that do
  // not wear.
  Real removed(int mesh) const { return meshes_[mesh].surface->removed(); }
  Real held_back(int mesh) const { return meshes_[mesh].surface->held_back(); }
  Real worn(int mesh) { return spec_.wears() ? loads_.worn(mesh) : 0; }    // volume
  // Returns the force, or the torque, of the mesh on the spheres along the axis of its servo.
  Real servo_push(int mesh);
  // Returns the body of a mesh, with velocities of the whole step, or null if the mesh is no body.
  const BodyMover *body(int mesh);
  MeshNodes &nodes(int mesh) { return *meshes_[mesh].nodes(); }    // of a mesh that has_nodes
  // Returns the forces of the last step on the nodes of a mesh with has_nodes, x y z, node after node: those of contacts and of its
  // pressure, summed over all processes.
  const std::vector<Real> &node_forces(int mesh);
  // Writes node_forces() to `to`, which must be in the memory in which the wall computes; node_of_row[k] is the node in row k. Returns
  // false if there are no forces, or not those of all processes. Local.
  bool put_node_forces(int mesh, Real *to, const std::vector<int> &node_of_row);
  // Adds the sum of arm times force over the contacts of this process, an energy, to six numbers: xx, yy, zz, xy, xz, yz. Local.
  void add_virial(Real *virial) const;
  // Calls row(sphere, numbers) for each sphere of this process that has a contact, with the spec().contact_columns() numbers of the
  // contacts array. Local.
  void for_contact_rows(const std::function<void(int, const Real *)> &row) const;

  // Calls found(contact) for each contact of this process in the last step, if spec().each_contact is set, sphere after sphere. If
  // spec().energy is set, it then calls found() for the contacts that the step has ended. Local.
  void for_contacts(const std::function<void(const WallContact &)> &found) const;

  // Writes the files that are due in this step.
  void write_due_files();
  int files_every() const { return files_.every(); }    // steps; 0: there are none. Local.

  // The following functions are called between steps. If one of them throws InputError, nothing has changed.

  // Returns the values of spec().inputs in the last step; none before the first one.
  const std::vector<Real> &last_inputs() const { return input_.inputs; }
  // Sets the values of spec().inputs in the step that was saved. Called before restore(): bodies end that step with these values, and
  // pressures act on nodes with them.
  void restore_inputs(const std::vector<Real> &values);
  // Replaces the names of inputs. Names may be added to the end of the list, or taken from it; others stay in their places.
  void set_inputs(const InputNames &inputs);
  // Returns why this mesh cannot have a motion, servo or pose, or an empty text if it can. Local.
  std::string why_it_takes_no_motion(int mesh) const { return meshes_[mesh].mover.why_no_motion(); }
  // Moves a mesh by another motion from where it is, or stops it if the motion has no terms. Its servo stays the same; the servo of
  // `motion` is not read.
  void set_motion(int mesh, const RigidMotion &motion, const Step &now);
  // Moves a mesh by another servo from where it is, or removes its servo if the new one is not present. A servo along the same line
  // continues from the position of the previous one.
  void set_servo(int mesh, const Servo &servo);
  // Sets what holds and drives a mesh that is a body: joint, spring, limits, motor, load, moment and gravity of `to`. The body continues
  // from where it is, without a jump. With another joint its coordinate begins at 0 there, and the part of its velocity that the joint
  // allows stays. The rest of `to` is not read.
  void set_body(int mesh, const BodySpec &to);
  // Throws InputError if the mesh is no body. Local.
  void check_is_body(int mesh) const;
  // Sets the pose of a mesh for the next step and those after it. The motion of the mesh must be is_posed(), and it must be no body and
  // have no nodes. Local.
  void set_pose(int mesh, const Pose &pose) { meshes_[mesh].mover.set_pose(pose); }
  // Sets places (length) and velocities (length/time) of the nodes of a mesh with has_nodes, x y z, node after node, for the next step and
  // those after it. Velocities are of the same time as those of spheres; if `v` is null they are 0. All processes give the same numbers.
  // Local.
  void set_nodes(int mesh, const Real *x, const Real *v) { nodes(mesh).set(x, v); }
  // Sets places and velocities of nodes from arrays in the memory in which the wall computes; see MeshNodes::set_in_place().
  void set_nodes_in_place(int mesh, const Real *x, const Real *v,
                          const std::vector<int> &node_of_row)
  {
    nodes(mesh).set_in_place(x, v, node_of_row);
  }

  // Writes the history of a sphere for a saved state. Features get names that are valid in any run. Returns how many numbers it wrote.
  // Local.
  int pack_saved(int sphere, Real *buffer);
  // Returns the state of the wall for saving, without the histories of spheres. Only the first process gets the loads, which are those of
  // all processes.
  WallState save();
  bool has_begun() const { return has_begun_; }    // whether a step was begun. Local.
  // Throws InputError if the first step cannot begin because a body is outside of its limits. Local.
  void check_start() const
  {
    for (const MeshPart &m : meshes_) m.mover.check_start();
  }
  // Keeps the wall as it was made until the first step, for a host that may call restore() more than once. It takes as much memory on each
  // process as a saved state.
  void keep_made();
  // Restores the state that another wall has saved, before the first step; all processes give the same state. Throws InputError, with
  // nothing changed, if a servo or a body would be outside of its limits.
  void restore(const WallState &was, const Step &now);
  // Restores the histories of the spheres of this process after restore(), each as pack_saved() wrote it. Warns of what does not fit.
  void restore_springs(const std::vector<std::vector<Real>> &spheres);

 private:
  // Make the engine, and another one when a different device or different settings are due.
  EngineSettings engine_settings() const
  {
    return engine_input_.settings(device_.device(), virial_, !bodies_.empty());
  }
  void make_engine();
  void replace_engine_if_due(const HostSpheres &spheres, const StepInput &input);
  Real most_candidates();
  void log_creation(const std::string &material, const WallBackend &backend) const;
  void log_device(Real near);    // `near`: most_candidates()

  // Keep the error of one process in a step.
  template <class Work>
  void guard(const HostSpheres &spheres, Work &&work);
  InputError failure_here(const HostSpheres &spheres) const;

  // The parts of begin(): the input, then the meshes, then grids and spheres.
  void open_step(const HostSpheres &spheres, const StepInput &input);
  void check_history(int n);
  void move(const HostSpheres &spheres);
  ServoLoad servo_load(int mesh);
  void complete_bodies();
  Touch touch(const MeshPart &m);    // in the last step
  void place_grids(const HostSpheres &spheres);
  void look_at_spheres(const HostSpheres &spheres);
  void look_at_new_spheres(const HostSpheres &spheres);
  void look_at_range(const HostSpheres &spheres);
  SpheresOnCpu on_cpu(const HostSpheres &spheres) const
  {
    return SpheresOnCpu(spheres, backend_.to_cpu);
  }

  // The parts of submit().
  void search_if_due(const Spheres &spheres);    // for candidates
  StepSettings step_settings();

  // The parts of finish().
  void collect(int n);
  StepResults *results() const;
  void note_poses();
  void note_step(const HostSpheres &spheres);
  void record(const StepResults *of_step);    // by triangle; null: this process has none
  void log_new_springs(const Step &step);
  StepDiagnostics read_diagnostics(const HostSpheres &spheres);
  void check_new_spheres(const HostSpheres &spheres);

  // Results of the last step.
  const StepTotals &sums();
  std::vector<NodeLoad> node_loads();
  Real pressure(int mesh) const;    // in this step, in units of forces

  // What a change of a mesh's motion, servo or body brings with it.
  void log_change(const MeshPart &m, const std::string &text);
  std::string named(const MeshPart &m, const std::string &text) const;
  void list_meshes();
  void note_mobility(const MeshPart &m);
  void mover_has_changed(const MeshPart &m);

  // What the wall was made from. The constructor sets all of it. Later set_motion(), set_servo() and set_body() change the spec of a mesh,
  // and set_inputs() the names of inputs.
  Host &host_;
  WallSpec spec_;
  LawTable laws_;    // of the spec
  WallBackend backend_;

  // The time of the spheres, which begin() advances. It differs from the host's time in a run that continues from a saved state, if the
  // host's time begins again.
  StepClock clock_;
  // The unit of pressures in inputs, from the constructor.
  Real pressure_unit_;

  // The meshes, at least one, from the constructor. They stay where they are in memory: the lists below point to them.
  std::deque<MeshPart> meshes_;

  // Lists of meshes that have something to do in a step, in the order of the meshes. The constructor makes them, and mover_has_changed()
  // makes them again. The first three say where meshes are; begin() and submit() read them.
  std::vector<MeshPart *> placed_;    // are, or may be, away from where their file has them
  // May move, or their surface may, as of a conveyor, in the next step; finish() drops those that have come to rest.
  std::vector<MeshPart *> moving_;
  std::vector<MeshPart *> changing_;    // change their shape

  // Two lists of meshes that the sums of contacts drive.
  std::vector<MeshPart *> bodies_, servos_;

  // Two lists of meshes for which finish() records by triangle: loads; energy and impacts.
  std::vector<MeshPart *> recorded_, with_energy_records_;

  // The nodes of the meshes whose nodes move. Only the constructor sets this list.
  std::vector<MeshNodes *> with_nodes_;

  // The coats of bodies. The constructor makes them, and finish() steps them.
  BodyCoats coats_;

  // The engine, and what decides its settings and its device. make_engine() makes an engine in the constructor, and in begin() if
  // replace_engine_if_due() finds that another one is due.
  EngineInput engine_input_;
  DeviceChoice device_;
  std::unique_ptr<WallEngine> engine_;

  // What make_engine() notes of the engine. replace_engine_if_due() reads whether its laws are compiled for meshes that move, and for contacts that are
  // asked for. submit() reads whether each step reads contacts for loads or wear.
  bool engine_moves_ = false, engine_contacts_ = false;
  bool reads_loads_ = false;

  // The history of contacts: with the engine in a step, and on the host where spheres move.
  HistoryExchange history_;

  // Sums over contacts. totals_ are those of the last step; finish() adds each step to the means and energies. Outputs read all of them.
  StepTotals totals_;
  MeanLoads means_;
  EnergyBooks energy_;

  // Sums by triangle, to which finish() adds each step, and the files that have them. write_due_files() writes the files.
  LoadRecorder loads_;
  EnergyRecorder records_;
  WallFiles files_;

  // What the log tells of a run. Steps add to it, and end_run() logs it.
  OverlapMonitor overlaps_;
  SearchReport search_;
  TimeReport times_;
  // The deepest overlap (length) since begin_run(), of what poll_diagnostics() has read.
  Real deepest_overlap_ = 0;

  // Checks of the timestep, of snapshots of a replay, and of meshes in the box, mostly in begin().
  TimestepCheck timestep_;
  SnapshotCheck snapshots_;
  BoxChecks box_checks_;

  // The grids of the meshes, which begin() makes fit the spheres and the box.
  GridManager grids_;
  // Does the work of save() and restore().
  StateKeeper keeper_;

  // What the host said of the step at begin(). All functions read it until the next begin().
  StepInput input_;
  // How far wear has moved the vertices of each mesh in this step: see StepSettings. change_surfaces() sets it, finish() clears it.
  // Empty: no vertex has moved so.
  std::vector<std::vector<Vec3>> receded_;
  // Where the meshes were in the last step that was finished. finish() sets it, for the sums of that step.
  std::vector<Pose> poses_;
  // The error of this process in this step, if there are other processes. guard() keeps it, and finish() throws it.
  std::optional<InputError> failure_;

  // How far the wall is in its runs. begin() sets all three.
  bool has_begun_ = false;     // a step was begun
  bool is_running_ = false;    // a step was begun, and end_run() has not been called since
  bool is_set_up_ = false;     // the last step set a run up: the next begin() may choose a device
  // Whether add_virial() may be called in this run. begin_run() sets it, and the next engine keeps contacts for it.
  bool virial_ = false;

  // Whether restore() was called. Then steps do not warn of springs that begin at 0, nor of spheres that were there before.
  bool continued_ = false;
  // Messages that the log has had; it has each only once.
  bool springs_told_ = false;     // springs begin at 0
  bool points_warned_ = false;    // all spheres have radius 0

  // The range of sphere sizes, for gains of servos and the timestep of bodies. begin() sets it if spheres may have come, or if it is not
  // known; set_servo() makes it unknown.
  SphereRange range_;
  bool range_is_known_ = false;
  // The radius (length) of the largest ball that fits in a grain. look_at_spheres() sets it; begin() compares how far meshes move with it.
  Real largest_within_ = 0;
};

}    // namespace lsdcd
