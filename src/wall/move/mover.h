// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What moves a mesh as a whole.
#pragma once

#include "host/host.h"
#include "rigid/mobility.h"
#include "rigid/step_limit.h"
#include "wall/coat_load.h"
#include "wall/mesh_state.h"
#include "wall/move/mesh_motion.h"
#include "wall/move/servo_controller.h"
#include "wall/sphere_range.h"
#include "wall/step_totals.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

class BodyMover;
class MeshGrid;

// What touched a mesh in the last step.
struct Touch {
  const MeshTotals &contacts;    // with the loads of coats
  const SphereRange &spheres;
  const CoatLoad &coat;
};

// In each step: complete() the last one, advance() all movers by what acted on their meshes there, place() all, and
// end() once contacts are computed. Errors are InputError, the same on all processes, with a text that names the mesh.
class Mover {
 public:
  // Returns the load of the last step. Collective.
  using LastLoad = std::function<ServoLoad()>;
  // Returns the largest rates() of the meshes that the coat of this one touches, or whose coats touch it.
  using RatesOfOthers = std::function<ModeRates(bool of_coat)>;

  // Moves the mesh with this number of the wall, from 0. Its time is 0 at `now`. Host and wall must outlive it.
  Mover(Host &host, WallSpec &wall, int mesh, const Step &now) :
      host_(host), wall_(wall), mesh_(mesh), motion_(host, wall, mesh, now)
  {
  }
  virtual ~Mover() = default;

  // Where the mesh is, in this step and the one before, and how its surface moves in its frame.
  const Pose &pose() const { return motion_.pose(); }
  const Pose &pose_before() const { return motion_.pose_before(); }
  const SurfaceMotion &surface_motion() const { return motion_.surface_motion(); }
  // Returns where it is that much time from now. A servo stays; of a body the step that comes, once the last one is
  // complete.
  virtual Pose pose_in(Real later) const { return motion_.pose_in(later); }
  bool moves() const { return motion().any(); }                         // or has moved it
  bool moves_or_varies() const { return motion_.moves_or_varies(); }    // for the engine
  // Returns whether it goes along this unit vector never, across which the box has this width, and turns about
  // nothing but it.
  virtual bool keeps(const Vec3 &edge, Real width) const;
  // Returns how long its way repeats after, or 0 where nobody knows where it will be.
  virtual Real known_period() const;
  // Those of the wall's inputs that it reads, by their numbers.
  std::vector<int> inputs() const { return motion_.inputs(); }
  // Returns how it gives way to pushes where it is now (1/mass), and the most where a sphere can touch a face.
  virtual Mobility mobility() const { return {}; }
  virtual Real most_mobility() const { return 0; }
  virtual bool is_pushed() const { return false; }    // by what touches it
  // Returns whether the host may put it anywhere, so that it is no error to go far in a step.
  virtual bool may_jump() const { return motion().is_posed(); }
  // Returns the body that it is, or null.
  virtual const BodyMover *body() const { return nullptr; }

  // Throws where the mesh would leave the plane of a run in two dimensions.
  virtual void check_plane() const { check_keeps_plane(motion()); }
  // Throws where it cannot begin where it is, before its first step. Local.
  virtual void check_start() const {}
  // Throws where the pose or velocities in a snapshot are not known from its time alone.
  virtual void check_snapshot(const Step &at) const { motion_.check_snapshot(at); }

  // Returns whether the last step waits for complete().
  virtual bool is_half_done() const { return false; }
  // Gives the last step its second half, by the loads of its contacts and with the values that inputs had. Returns the
  // pose with the velocities of the whole step.
  virtual Pose complete(const MeshTotals &, const Vec3 & /* gravity */) { return pose(); }
  // Returns how fast modes are on what touches the mesh, in the step that was completed. `of_coat`: exactly on coats, and
  // by a bound on spheres; else by bounds, which cost nothing.
  virtual ModeRates rates(const Touch &, bool /* of_coat */) const { return {}; }
  // Throws where the timestep of the step that was completed is too long for what touches the mesh.
  virtual void check_step(const Touch &, const RatesOfOthers &) {}
  // Goes on to this step, whose inputs have these values, one for each input of the wall.
  virtual void advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load);
  // Puts the mesh where it has come to.
  void place() { motion_.place(); }
  // Ends a step. `results`: of its contacts on this process; null: there are none.
  virtual void end(const Step &, const StepResults * /* results */) {}
  // Returns whether end() needs the contacts themselves.
  virtual bool asks_for_contacts() const { return false; }

  // Returns the force, or the torque, of the mesh on the spheres along the axis of its servo.
  virtual Real servo_push(const ServoLoad &) const { return 0; }
  virtual bool has_servo() const { return false; }    // that is present
  virtual bool servo_acts() const { return false; }

  // Returns why it takes no motion, servo or pose, or an empty text if it takes them.
  virtual std::string why_no_motion() const = 0;
  // These change what moves the mesh, from where it is; see Wall. Where they throw nothing has changed.
  virtual void set_motion(const RigidMotion &to, const Step &now);
  virtual void set_servo(const Servo &to);
  virtual void set_pose(const Pose &pose);
  virtual void set_body(const BodySpec &to);
  void check_takes_motion() const;
  virtual void check_is_body() const;

  // Returns lines of the log, which are empty where there is nothing to say. `bounds`: of the mesh in its own frame.
  virtual std::string text(const Box &bounds) const { return motion_.text(bounds); }
  virtual std::string servo_text() const { return ""; }
  virtual std::string body_text() const { return ""; }

  // Writes what it needs to go on into a saved state. restore() takes it again where check() does not throw: it is the
  // same on all processes. It goes on where it was as far as it is the same mover, and the first process warns of what is
  // not. Both are collective.
  virtual void save(MeshState &to) const;
  virtual void check(const MeshState &) const {}
  virtual void restore(const MeshState &was, const Step &now) = 0;

 protected:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  RigidMotion &motion() const { return spec().motion; }
  std::string named(const std::string &text) const;
  // Throws where this motion would take the mesh out of the plane of a run in two dimensions.
  void check_keeps_plane(const RigidMotion &motion) const;

  Host &host_;
  WallSpec &wall_;
  int mesh_;
  MeshMotion motion_;    // where it is, its clock, and the values of inputs
};

// Makes what the spec of a mesh says. `force`: of the wall's units, in mass length / time^2. Host, wall, laws and grid must outlive
// it. Throws InputError on all processes. Collective.
std::unique_ptr<Mover> make_mover(Host &host, WallSpec &wall, const LawTable &laws, int mesh,
                                  const MeshGrid &grid, Real force, const Step &now);

}    // namespace lsdcd
