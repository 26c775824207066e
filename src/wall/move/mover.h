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

  // Moves the mesh with this number of the wall, from 0. Its time is 0 at `now`. `force`: of the wall's units, in mass length /
  // time^2. Host, wall, laws and grid must outlive it. Throws InputError on all processes. Collective.
  Mover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
        Real force, const Step &now);

  Mover(const Mover &) = delete;    // its body poses its motion

  BodyMover *body() const { return body_.get(); }    // null: the mesh is none

  // Where the mesh is, in this step and the one before, and how its surface moves in its frame.
  const Pose &pose() const { return motion_.pose(); }
  const Pose &pose_before() const { return motion_.pose_before(); }
  const SurfaceMotion &surface_motion() const { return motion_.surface_motion(); }
  // Returns where it is that much time from now. A servo stays; of a body the step that comes, once the last one is
  // complete.
  Pose pose_in(Real later) const { return body_ ? body_->pose_in(later) : motion_.pose_in(later); }
  bool moves_or_varies() const { return motion_.moves_or_varies(); }    // for the engine
  // Returns whether it goes along this unit vector never, across which the box has this width, and turns about
  // nothing but it.
  bool keeps(const Vec3 &edge, Real width) const;
  // Returns how long its way repeats after, or 0 where nobody knows where it will be.
  Real known_period() const;
  // Those of the wall's inputs that it reads, by their numbers.
  std::vector<int> inputs() const { return motion_.inputs(); }
  // Returns whether the host may put it anywhere, so that it is no error to go far in a step.
  bool may_jump() const { return !body_ && motion().is_posed(); }

  // Throws where the mesh would leave the plane of a run in two dimensions.
  void check_plane() const;
  // Throws where it cannot begin where it is, before its first step. Local.
  void check_start() const
  {
    if (body_) body_->check_start();
  }
  // Throws where the pose or velocities in a snapshot are not known from its time alone.
  void check_snapshot(const Step &at) const;

  // Goes on to this step, whose inputs have these values, one for each input of the wall.
  void advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load);
  // Takes the values of inputs, which advance() takes in each step.
  void take_inputs(const std::vector<Real> &inputs) { motion_.take_inputs(inputs); }
  // Puts the mesh where it has come to.
  void place() { motion_.place(); }
  // Returns the force, or the torque, of the mesh on the spheres along the axis of its servo.
  Real servo_push(const ServoLoad &load) const { return servo_.push(load); }
  bool servo_acts() const { return servo_.acts(); }

  // Returns why it takes no motion, servo or pose, or an empty text if it takes them.
  std::string why_no_motion() const;
  // These change what moves the mesh, from where it is; see Wall. Where they throw nothing has changed: the host poses the mesh, or
  // it does not, or something else moves it.
  void set_motion(const RigidMotion &to, const Step &now);
  void set_servo(const Servo &to);
  void set_pose(const Pose &pose);

  // Returns lines of the log, which are empty where there is nothing to say. `bounds`: of the mesh in its own frame.
  std::string text(const Box &bounds) const { return body_ ? "" : motion_.text(bounds); }
  std::string servo_text() const;

  // Writes what it needs to go on into a saved state. restore() takes it again where check() does not throw: it is the
  // same on all processes. It goes on where it was as far as it is the same mover, and the first process warns of what is
  // not. Both are collective.
  void save(MeshState &to) const;
  void check(const MeshState &was) const;
  void restore(const MeshState &was, const Step &now);

 private:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  RigidMotion &motion() const { return spec().motion; }
  std::string named(const std::string &text) const;
  // Throws where this motion would take the mesh out of the plane of a run in two dimensions.
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
