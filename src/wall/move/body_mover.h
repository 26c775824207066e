// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Moves a mesh as a rigid body: what acts on it, its steps, and what they ask of the timestep.
#pragma once

#include "host/host.h"
#include "rigid/mobility.h"
#include "rigid/rigid_body.h"
#include "rigid/step_limit.h"
#include "wall/move/mesh_motion.h"
#include "wall/saved/mesh_state.h"
#include "wall/spheres/sphere_range.h"
#include "wall/sums/coat_load.h"
#include "wall/sums/step_totals.h"
#include "wall/surface/mesh_grid.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lsdcd {

// What touched a mesh in the last step.
struct Touch {
  const MeshTotals &contacts;    // with the loads of coats
  const SphereRange &spheres;
  const CoatLoad &coat;
};

// Moves one mesh as a rigid body. In each step complete() ends the last one, advance() follows, and end() once contacts are computed.
// Velocities are those of half a step before complete(), and of the whole step after it.
class BodyMover {
 public:
  // Returns the largest rates() of the meshes that the coat of this one touches, or whose coats touch it.
  using RatesOfOthers = std::function<ModeRates(bool of_coat)>;

  // Makes the body of this mesh of the wall, counted from 0, by its spec there. `force`: of the wall's units, in mass length / time^2.
  // `motion`: that of the mesh, which the body poses. All arguments must outlive this object. Throws InputError on all processes.
  // Collective.
  BodyMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
            Real force, MeshMotion &motion);

  const RigidBody &rigid() const { return body_; }
  // Returns the mobility without stops, for forces in the wall's units.
  const Mobility &mobility_to_forces() const { return mobility_; }
  // Return what the joint and its stop did in the last step, even if another joint holds the body from the next one on.
  Wrench reaction() const { return was_held_ ? was_held_->reaction : body_.reaction(load_); }
  Real stop_force() const { return was_held_ ? was_held_->stop_force : body_.stop_force(load_); }
  Real spring_and_kinetic_energy() const;

  // Returns where the body is in the next step, once the last one is complete.
  Pose pose_in(Real later) const;
  // Returns whether the mesh is always where its file has it along this unit vector, and turns about no other axis. `width`: of the box in
  // this direction.
  bool keeps(const Vec3 &edge, Real width) const { return body_.keeps(edge, width); }
  // Return how the body gives way to pushes where it is now (1/mass), and how it does at most where a sphere can touch a face.
  Mobility mobility() const { return 1 / force_ * body_.mobility(); }
  Real most_mobility() const { return most_mobility_ / force_; }

  // Throw if the mesh would leave the plane of a run in two dimensions, and in any snapshot.
  void check_plane() const { check_keeps_plane(body_spec().joint); }
  [[noreturn]] void check_snapshot() const;
  // Throws if the body cannot begin where it is. A body without a saved state begins where it was made. Local.
  void check_start() const;

  bool is_half_done() const { return pending_; }    // the last step waits for complete()
  // Makes the second half of the last step, by the loads of its contacts and with the values that inputs had. Returns the pose with the
  // velocities of the whole step.
  Pose complete(const MeshTotals &contacts, const Vec3 &gravity);
  // Returns the rates of the body's modes on what touches the mesh, in the step that was completed. `of_coat`: exactly for coats, and a
  // bound for spheres; otherwise bounds, which cost nothing.
  ModeRates rates(const Touch &touch, bool of_coat) const;
  // Throws if the timestep of the step that was completed is too long for what touches the mesh.
  void check_step(const Touch &touch, const RatesOfOthers &of_others);
  // Makes half a step by the load of the last one, and moves the body. Inputs may change before.
  void advance(const Step &to, const std::vector<Real> &inputs);
  // Notes the loads of this process. Sums over all processes are made when they are asked for.
  void end(const Step &step, const StepResults *results);
  // Returns whether the next step must bring its contacts, because their number alone allows no judgement of the timestep.
  bool asks_for_contacts() const { return asks_for_contacts_; }

  void set_body(const BodySpec &to);

  std::string body_text() const;

  void save(MeshState &to) const;
  // Throws if restore() would put the body where none may be, as outside of its limits.
  void check(const MeshState &was) const;
  // Continues from the state of a body, after that of its motion was restored.
  void restore(const BodyState &was);

 private:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  const BodySpec &body_spec() const { return spec().body; }
  std::string named(const std::string &text) const;
  void place();
  // Sets the spec and the body, and all that follows from them: for a new body, for other words and for a saved state. Collective.
  void go_on(const BodySpec &to, const RigidBody &as);
  void check_keeps_plane(const Joint &joint) const;
  void check_spec(const BodySpec &to) const;
  void check_limits(const BodySpec &to, const RigidBody &as) const;
  void ask_about_degrees() const;
  bool is_same(const BodyState &was) const;
  RigidBody continued(const BodyState &was) const;
  // Returns whether the load of the step presses the body into a stop. The body has no modes then.
  bool is_held() const { return body_.is_held(load_); }
  ContactSum spring() const;
  void sum_contacts(const StepResults *results);
  ModeRates of_spheres(const Touch &touch) const;
  [[noreturn]] void fail_step(Real longest, Real contacts) const;
  void warn_of_step(Real longest, Real contacts);

  Host &host_;
  WallSpec &wall_;
  int mesh_;
  MeshMotion &motion_;
  const LawTable &laws_;
  const MeshGrid &grid_;
  Real force_;
  RigidBody body_;    // its mass over force_, so that forces are in the wall's units
  Mobility mobility_;
  Real most_mobility_ = 0, bound_of_mobility_ = 0;    // of faces; of any point
  Wrench load_;
  std::optional<JointLoad>
      was_held_;    // of a joint that another one has replaced since, or of a saved state
  bool place_is_known_ = false;    // by a step or a saved state; a new body may get one yet
  bool pending_ = false;
  Real dt_ = 0;    // of the step that is pending

  bool asks_for_contacts_ = false, has_contacts_ = false, step_warned_ = false;
  ContactSum stiffness_, damping_;
  Real most_of_sphere_[2] = {0, 0};    // stiffness and damping over the mass of a sphere
};

}    // namespace lsdcd
