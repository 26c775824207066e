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

// In each step: complete() the last one, advance(), and end() once contacts are computed. Velocities are those of half a step before complete(), and of the whole step after it.
class BodyMover {
 public:
  // Returns the largest rates() of the meshes that the coat of this one touches, or whose coats touch it.
  using RatesOfOthers = std::function<ModeRates(bool of_coat)>;

  // Makes the body of the mesh with this number of the wall, from 0, with its `body` there. `force`: of the wall's units, in mass length /
  // time^2. `motion`: of the mesh, which it poses. All must outlive it. Throws InputError on all processes. Collective.
  BodyMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
            Real force, MeshMotion &motion);

  const RigidBody &rigid() const { return body_; }
  // Without stops, and of forces in the wall's units.
  const Mobility &mobility_to_forces() const { return mobility_; }
  // Return what the joint and its stop did in the last step, whatever holds the body from the next one on.
  Wrench reaction() const { return was_held_ ? was_held_->reaction : body_.reaction(load_); }
  Real stop_force() const { return was_held_ ? was_held_->stop_force : body_.stop_force(load_); }
  Real spring_and_kinetic_energy() const;

  // Returns where it is in the step that comes, once the last one is complete.
  Pose pose_in(Real later) const;
  // Returns whether it goes along this unit vector never, across which the box has this width, and turns about nothing but it.
  bool keeps(const Vec3 &edge, Real width) const { return body_.keeps(edge, width); }
  // Return how it gives way to pushes where it is now (1/mass), and the most where a sphere can touch a face.
  Mobility mobility() const { return 1 / force_ * body_.mobility(); }
  Real most_mobility() const { return most_mobility_ / force_; }

  // Throw where the mesh would leave the plane of a run in two dimensions; in a snapshot.
  void check_plane() const { check_keeps_plane(body_spec().joint); }
  [[noreturn]] void check_snapshot() const;
  // Throws where it cannot begin where it is. A body without a saved state begins where it was made. Local.
  void check_start() const;

  bool is_half_done() const { return pending_; }    // the last step waits for complete()
  // Gives the last step its second half, by the loads of its contacts and with the values that inputs had. Returns the
  // pose with the velocities of the whole step.
  Pose complete(const MeshTotals &contacts, const Vec3 &gravity);
  // Returns how fast modes are on what touches the mesh, in the step that was completed. `of_coat`: exactly on coats, and
  // by a bound on spheres; else by bounds, which cost nothing.
  ModeRates rates(const Touch &touch, bool of_coat) const;
  // Throws where the timestep of the step that was completed is too long for what touches the mesh.
  void check_step(const Touch &touch, const RatesOfOthers &of_others);
  // Half a step by the load of the last one, and the way. Inputs may change before.
  void advance(const Step &to, const std::vector<Real> &inputs);
  // Notes the loads of this process: sums over all are made when they are asked for.
  void end(const Step &step, const StepResults *results);
  // Where the number of contacts allows no judgement of the timestep.
  bool asks_for_contacts() const { return asks_for_contacts_; }

  void set_body(const BodySpec &to);

  std::string body_text() const;

  void save(MeshState &to) const;
  // Throws where restore() would begin as no body may, as outside of its limits.
  void check(const MeshState &was) const;
  // Goes on as this one, after its motion.
  void restore(const BodyState &was);

 private:
  MeshSpec &spec() const { return wall_.meshes[mesh_]; }
  const BodySpec &body_spec() const { return spec().body; }
  std::string named(const std::string &text) const;
  void place();
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
