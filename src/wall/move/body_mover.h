// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Moves a mesh as a rigid body: what acts on it, its steps, and what they ask of the timestep.
#pragma once

#include "rigid/rigid_body.h"
#include "wall/move/mover.h"
#include "wall/surface/mesh_grid.h"

#include <optional>
#include <string>

namespace lsdcd {

// Velocities are those of half a step before complete(), and of the whole step after it.
class BodyMover final : public Mover {
 public:
  // Makes the body of the mesh with this number of the wall, from 0, with its `body` there. `force`: of the wall's units, in mass length /
  // time^2. Host, wall, laws and grid must outlive it. Throws InputError on all processes. Collective.
  BodyMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
            Real force, const Step &now);

  const RigidBody &rigid() const { return body_; }
  // Without stops, and of forces in the wall's units.
  const Mobility &mobility_to_forces() const { return mobility_; }
  // Return what the joint and its stop did in the last step, whatever holds the body from the next one on.
  Wrench reaction() const { return was_held_ ? was_held_->reaction : body_.reaction(load_); }
  Real stop_force() const { return was_held_ ? was_held_->stop_force : body_.stop_force(load_); }
  Real spring_and_kinetic_energy() const;

  Pose pose_in(Real later) const override;
  bool keeps(const Vec3 &edge, Real width) const override { return body_.keeps(edge, width); }
  Mobility mobility() const override { return 1 / force_ * body_.mobility(); }
  Real most_mobility() const override { return most_mobility_ / force_; }
  bool is_pushed() const override { return true; }
  bool may_jump() const override { return false; }
  const BodyMover *body() const override { return this; }

  void check_plane() const override { check_keeps_plane(body_spec().joint); }
  // A body without a saved state begins where it was made.
  void check_start() const override;
  void check_snapshot(const Step &at) const override;

  bool is_half_done() const override { return pending_; }
  Pose complete(const MeshTotals &contacts, const Vec3 &gravity) override;
  ModeRates rates(const Touch &touch, bool of_coat) const override;
  void check_step(const Touch &touch, const RatesOfOthers &of_others) override;
  // Half a step by the load of the last one, and the way. Inputs may change before.
  void advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load) override;
  // Notes the loads of this process: sums over all are made when they are asked for.
  void end(const Step &step, const StepResults *results) override;
  // Where the number of contacts allows no judgement of the timestep.
  bool asks_for_contacts() const override { return asks_for_contacts_; }

  std::string why_no_motion() const override
  {
    return "a body moves by what acts on it, so it cannot have a motion, a servo or a pose";
  }
  void set_body(const BodySpec &to) override;
  void check_is_body() const override {}

  std::string text(const Box &) const override { return ""; }
  std::string body_text() const override;

  void save(MeshState &to) const override;
  // Throws where restore() would begin as no body may, as outside of its limits.
  void check(const MeshState &was) const override;
  void restore(const MeshState &was, const Step &now) override;

 private:
  const BodySpec &body_spec() const { return spec().body; }
  // Takes what becomes of it, and makes all that follows: for a new body, other words and a saved state. Collective.
  void go_on(const BodySpec &to, const RigidBody &as);
  void check_keeps_plane(const Joint &joint) const;
  void check_spec(const BodySpec &to) const;
  void check_limits(const BodySpec &to, const RigidBody &as) const;
  void ask_about_degrees() const;
  bool is_same(const BodyState &was) const;
  RigidBody continued(const BodyState &was) const;
  // Returns whether it is pressed into a stop by the load of the step. It has no modes then.
  bool is_held() const { return body_.is_held(load_); }
  ContactSum spring() const;
  void sum_contacts(const StepResults *results);
  ModeRates of_spheres(const Touch &touch) const;
  [[noreturn]] void fail_step(Real longest, Real contacts) const;
  void warn_of_step(Real longest, Real contacts);

  const LawTable &laws_;
  const MeshGrid &grid_;
  Real force_;
  RigidBody body_;    // its mass over force_, so that forces are in the wall's units
  Mobility mobility_;
  Real most_mobility_ = 0, bound_of_mobility_ = 0;    // of faces; of any point
  Wrench load_;
  // In the last step, by a joint that another one has replaced since.
  struct Held {
    Wrench reaction;
    Real stop_force;
  };
  std::optional<Held> was_held_;
  bool place_is_known_ = false;    // by a step or a saved state; a new body may get one yet
  bool pending_ = false;
  Real dt_ = 0;    // of the step that is pending

  bool asks_for_contacts_ = false, has_contacts_ = false, step_warned_ = false;
  ContactSum stiffness_, damping_;
  Real most_of_sphere_[2] = {0, 0};    // stiffness and damping over the mass of a sphere
};

}    // namespace lsdcd
