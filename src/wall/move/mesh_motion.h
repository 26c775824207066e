// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a mesh is in each step: its motion, the clock of that, and the inputs it hangs on.
#pragma once

#include "host/host.h"
#include "motion/step_clock.h"
#include "wall/saved/mesh_state.h"
#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

// Functions throw InputError, the same on all processes, with a text that names the mesh.
class MeshMotion {
 public:
  // Makes the motion of this mesh of the wall, counted from 0, by its spec there, which later motions change. The time of the motion is 0
  // at `now`. Host and wall must outlive this object.
  MeshMotion(Host &host, WallSpec &wall, int mesh, const Step &now);

  const Pose &pose() const { return pose_; }    // in this step
  // Returns the pose in the step before or, if no time has passed since then, in this step.
  const Pose &pose_before() const { return has_before_ ? before_ : pose_; }
  // Returns how the surface moves by itself, at the time of the spheres' velocities.
  const SurfaceMotion &surface_motion() const { return surface_; }

  bool moves_or_varies() const;    // does the engine see a motion?
  bool has_inputs() const;
  bool takes_differences() const;    // for velocities that no input gives
  bool adds_up() const;              // velocities to displacements that no input gives
  // Returns which of the wall's inputs the motion reads, by their numbers.
  std::vector<int> inputs() const;

  // Moves the clock on to this step, whose inputs have these values, one for each input of the wall. Returns the time that has passed.
  Real advance(const Step &to, const std::vector<Real> &inputs);
  // Takes the values of inputs, which advance() takes in each step.
  void take_inputs(const std::vector<Real> &inputs);
  // Puts the mesh where the motion and the servo have it now.
  void place();
  Pose pose_in(Time later) const;    // that much time from now
  Pose pose_without_servo() const;

  // Sets the terms of another motion, which begin where the mesh is; without terms the mesh stops. The servo continues with what it has
  // added up, except for one that holds when terms come: its position is 0 where the mesh is.
  void set(const RigidMotion &to, const Step &now);
  // Sets another servo, which begins where the mesh is; one that is not present stops the mesh. Along the same line the position continues.
  void set(const Servo &to);

  // Throws if the pose or velocities in a snapshot are not known from its time alone.
  void check_snapshot(const Step &at) const;

  // Returns a line for the log; empty: nothing moves. `bounds`: of the mesh in its own frame.
  std::string text(const Box &bounds) const;

  // Returns the state of the motion for a saved state, the same on all processes. After restore() a motion with the same terms continues
  // where it was. Other terms begin where the mesh was, and the first process warns.
  MotionState state() const;
  // Throws if restore() would put a servo outside of its limits.
  void check(const MotionState &was) const;
  void restore(const MotionState &was, const Step &now);

 private:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  Servo &servo() const { return spec().motion.servo(); }
  std::string named(const std::string &text) const;
  std::string own_text() const;
  // Reads tables on the first process, and gives all processes their rows. Collective if there is a table that was not read yet.
  void read_tables(std::vector<MotionTerm> &terms) const;
  void begin(const Step &now);
  void check_limits(const Servo &s, Real position) const;

  Host &host_;
  WallSpec &wall_;
  int mesh_;
  StepClock clock_;
  Pose pose_, before_;
  bool has_before_ = false;
  Real last_step_ = 0;                     // how long it was; 0: none has led to this place
  SurfaceMotion surface_, surface_now_;    // half a step ago, and now
  bool has_values_ = false;                // of inputs, from a step or a saved state
};

}    // namespace lsdcd
