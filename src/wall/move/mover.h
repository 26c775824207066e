// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What moves a mesh as a whole.
#pragma once

#include "host/host.h"
#include "wall/move/body_mover.h"
#include "wall/move/mesh_motion.h"
#include "wall/move/servo_controller.h"
#include "wall/saved/mesh_state.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// A motion by terms or poses, beside which there is a servo, a body, or neither. In each step: advance() by what acted on the mesh in
// the last one, place() all. Errors are InputError, the same on all processes, with a text that names the mesh.
class Mover {
 public:
  // Returns the load of the last step. Collective.
  using LastLoad = std::function<ServoLoad()>;

  // Moves this mesh of the wall, counted from 0. The time of its motion is 0 at `now`. `force`: of the wall's units, in mass length /
  // time^2. Host, wall, laws and grid must outlive this object. Throws InputError on all processes. Collective.
  Mover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
        Real force, const Step &now);

  Mover(const Mover &) = delete;    // its body poses its motion

  BodyMover *body() const { return body_.get(); }    // null: the mesh is none

  // Return where the mesh is in this step and in the one before, and how its surface moves in its frame.
  const Pose &pose() const { return motion_.pose(); }
  const Pose &pose_before() const { return motion_.pose_before(); }
  const SurfaceMotion &surface_motion() const { return motion_.surface_motion(); }
  // Returns where the mesh is after so much time. A servo stays where it is; a body is where it is in the next step, once the last one is
  // complete.
  Pose pose_in(Real later) const { return body_ ? body_->pose_in(later) : motion_.pose_in(later); }
  bool moves_or_varies() const { return motion_.moves_or_varies(); }    // for the engine
  // Returns whether the mesh is always where its file has it along this unit vector, and turns about no other axis. `width`: of the box in
  // this direction.
  bool keeps(const Vec3 &edge, Real width) const;
  // Returns the longest period of the motion; 0: it has none, or it hangs on inputs, so that nobody knows where the mesh will be.
  Real known_period() const;
  // Returns which of the wall's inputs the motion reads, by their numbers.
  std::vector<int> inputs() const { return motion_.inputs(); }
  // Returns whether the host may put the mesh anywhere, so that it is no error if it goes far in a step.
  bool may_jump() const { return !body_ && motion().is_posed(); }

  // Throws if the mesh would leave the plane of a run in two dimensions.
  void check_plane() const;
  // Throws if the mesh cannot begin where it is. Called before its first step. Local.
  void check_start() const
  {
    if (body_) body_->check_start();
  }
  // Throws if the pose or velocities in a snapshot are not known from its time alone.
  void check_snapshot(const Step &at) const;

  // Moves the clock on to this step, whose inputs have these values, one for each input of the wall.
  void advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load);
  // Takes the values of inputs, which advance() takes in each step.
  void take_inputs(const std::vector<Real> &inputs) { motion_.take_inputs(inputs); }
  // Puts the mesh where its motion, servo or body has it now.
  void place() { motion_.place(); }
  // Returns the force, or the torque, of the mesh on the spheres along the axis of its servo.
  Real servo_push(const ServoLoad &load) const { return servo_.push(load); }
  bool servo_acts() const { return servo_.acts(); }

  // Returns why the mesh takes no motion, servo or pose, or an empty text if it takes them.
  std::string why_no_motion() const;
  // Change what moves the mesh, from where it is; see Wall. They throw, with nothing changed, if the host poses the mesh, for set_pose() if
  // it does not, or if something else moves the mesh.
  void set_motion(const RigidMotion &to, const Step &now);
  void set_servo(const Servo &to);
  void set_pose(const Pose &pose);

  // Return lines of the log; empty: there is nothing to say. `bounds`: of the mesh in its own frame.
  std::string text(const Box &bounds) const { return body_ ? "" : motion_.text(bounds); }
  std::string servo_text() const;

  // save() writes what the mover needs to continue into a saved state. restore() continues from a state that is the same on all processes,
  // and for which check() does not throw. The first process warns of what is of another mover. save() and restore() are collective.
  void save(MeshState &to) const;
  void check(const MeshState &was) const;
  void restore(const MeshState &was, const Step &now);

 private:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  RigidMotion &motion() const { return spec().motion; }
  std::string named(const std::string &text) const;
  // Throws if this motion would take the mesh out of the plane of a run in two dimensions.
  void check_keeps_plane(const RigidMotion &motion) const;
  void check_posed(bool posed) const;

  Host &host_;
  WallSpec &wall_;
  int mesh_;
  MeshMotion motion_;    // where it is, its clock, and the values of inputs
  ServoController servo_;
  std::unique_ptr<BodyMover> body_;    // null: the mesh is none
};

}    // namespace lsdcd
