// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh as a rigid body: what acts on it, its steps, and what they ask of the timestep.
#pragma once

#include "host/host.h"
#include "rigid/rigid_body.h"
#include "rigid/step_limit.h"
#include "wall/coat_load.h"
#include "wall/mesh_grid.h"
#include "wall/step_totals.h"
#include "wall/wall_spec.h"

#include <functional>
#include <string>

namespace lsdcd {

// The spheres that can touch it, now or later.
struct SphereRange {
  Real radius = 0;                // the largest
  Real mass = 0, lightest = 0;    // the largest and smallest; 0: there is none
};

// For a restart.
struct BodyState {
  bool present = false;
  MassProperties mass;
  Joint joint;
  RigidState state;
  Wrench load;    // of the last step, by which the next one begins
};

// In the order of a step: advance() takes it to where contacts are computed, note_step() tells that they are, and
// complete() gives it their load, whenever somebody asks for its velocities or the next step begins. Velocities are
// those of half a step before complete(), and of the whole step after it.
class BodyMover {
 public:
  // Makes the body of the mesh with this number of the wall, from 0, with its `body` there. `force`: of the wall's units, in mass length /
  // time^2. Host, wall and laws must outlive it. Throws InputError on all processes. Collective.
  BodyMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
           Real force);

  const RigidBody &body() const { return body_; }
  // To pushes where it is now; 1/mass.
  Mobility mobility() const { return 1 / force_ * body_.mobility(); }
  // Without stops, and of forces in the wall's units.
  const Mobility &mobility_to_forces() const { return mobility_; }
  // Returns the largest n.K n where a sphere can touch a face; 1/mass.
  Real most_mobility() const { return most_mobility_ / force_; }
  Wrench reaction() const { return body_.reaction(load_); }
  Real stop_force() const { return body_.stop_force(load_); }
  Real spring_and_kinetic_energy() const;

  // Half a step by the load of the last one, and the way. Inputs may change before.
  void advance(Real dt);
  // Returns where advance() would take it, once the last step is complete.
  Pose pose_in(Real dt) const;
  // The step that follows it: 0 where no time has passed, in the set-up of a run.
  void note_step(Real dt);
  bool is_complete() const { return !pending_; }
  // Half a step by the load of this one: the contacts', and the rest with the values of inputs in this step.
  void complete(const MeshTotals &contacts, const Vec3 &gravity);

  // Returns the step that was completed: fast modes of the body on its spring and on all that touches it. `of_coat`:
  // exactly on its spring and coats, and by a bound on spheres; else by bounds, which cost nothing.
  ModeRates rates(const MeshTotals &contacts, const SphereRange &spheres, const CoatLoad &coat,
                  bool of_coat) const;
  // Throws InputError where the timestep is too long for what touches it. `of_others`: the largest rates() of the
  // bodies that it touches. Collective.
  void check_step(const MeshTotals &contacts, const SphereRange &spheres, const CoatLoad &coat,
                  const std::function<ModeRates(bool of_coat)> &of_others);

  // Does complete() need the contacts themselves, as their number allows no judgement?
  bool asks_for_contacts() const { return asks_for_contacts_; }
  // Those of this process in the step that was computed, with outputs and states per sphere and contacts.
  void sum_contacts(const StepResults &results);

  // Joint, drive, loads and gravity of `to`, from where it is; see Wall::set_body(). Collective.
  void set(const BodySpec &to);

  // Line of the log.
  std::string text() const;

  BodyState state() const;
  // Throws InputError where restore() would begin as no body may, as outside of its limits.
  void check(const BodyState &was) const;
  // Goes on as it was; with another mass or joint from where it was. The first process warns. Collective.
  void restore(const BodyState &was);

 private:
  const BodySpec &spec() const { return wall_.meshes[mesh_].body; }
  std::string named(const std::string &text) const;
  // Checks what becomes of it, takes it, and makes all that follows from it: for a new body, other words and a saved state.
  // Throws InputError, and then nothing has changed. Collective.
  void go_on(const BodySpec &to, const RigidBody &as);
  void check(const BodySpec &to, const RigidBody &as) const;
  void ask_about_degrees() const;
  bool is_same(const BodyState &was) const;
  RigidBody continued(const BodyState &was) const;
  // Returns whether it is pressed into a stop by the load of the step. It has no modes then.
  bool is_held() const { return body_.is_held(load_); }
  ContactSum spring() const;
  ModeRates of_spheres(const MeshTotals &contacts, const SphereRange &spheres) const;
  [[noreturn]] void fail_step(Real longest, Real contacts) const;

  Host &host_;
  WallSpec &wall_;
  const LawTable &laws_;
  int mesh_;
  const MeshGrid &grid_;
  Real force_;
  RigidBody body_;    // its mass over force_, so that forces are in the wall's units
  Mobility mobility_;
  Real most_mobility_ = 0, bound_of_mobility_ = 0;    // of faces; of any point
  Wrench load_;
  bool pending_ = false;
  Real dt_ = 0;    // of the step that is pending

  bool asks_for_contacts_ = false, has_contacts_ = false;
  ContactSum stiffness_, damping_;
  Real most_of_sphere_[2] = {0, 0};    // stiffness and damping over the mass of a sphere
};

}    // namespace lsdcd
