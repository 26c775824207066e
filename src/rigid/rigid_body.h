// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A rigid body, free or held by a joint, and how it goes on in time.
//
// A body moves by the coordinates that its joint leaves it, so that it cannot leave the joint. In a step of leapfrog
// it takes kick(dt / 2) by what acts in the step before, drift(dt), and, once what acts is known where it is now,
// kick(dt / 2): velocities are those of half a step while contacts see them, as those of spheres in LAMMPS.
#pragma once

#include "base/quaternion.h"
#include "motion/pose.h"
#include "rigid/joint.h"
#include "rigid/mass_properties.h"
#include "rigid/mobility.h"

namespace lsdcd {

// A force, and a torque about the origin of the box.
struct Wrench {
  Vec3 force = {0, 0, 0}, torque = {0, 0, 0};

  Vec3 torque_about(const Vec3 &point) const { return torque - cross(point, force); }
};

// All that a step changes.
struct RigidState {
  Vec3 home = {0, 0, 0};    // the centre where coordinates are 0, in the box
  Quaternion home_turn;     // the turn there, from the frame of the mesh to the box
  Vec3 centre = {0, 0, 0};
  Quaternion turn;
  // free: velocity of the centre, and angular momentum about it, in the box. ball: the latter, about the joint's point.
  Vec3 velocity = {0, 0, 0}, momentum = {0, 0, 0};
  // hinge and slider: the first. planar: two lengths in the plane, and an angle. With their derivatives.
  Real coordinate[3] = {0, 0, 0}, rate[3] = {0, 0, 0};
};

class RigidBody {
 public:
  RigidBody() = default;
  // At rest where the mesh is in its own frame, which is that of the box then. Units of force and mass go together
  // (force = mass length / time^2).
  RigidBody(const MassProperties &mass, const Joint &joint);

  JointDrive drive;    // may change between steps

  // Takes away the velocity into a stop at which the body is: to be called where it, or its limits, are others.
  void hold_at_stop();

  // Velocity of the centre and angular velocity. Throws InputError where the joint does not allow them.
  void set_velocity(const Vec3 &velocity, const Vec3 &omega);
  // Begins where another body of the same mesh is, with its velocity as the joint leaves it: projected, in the metric of mass
  // and inertia, onto what the joint allows. Kinetic energy falls by that of the difference. A coordinate goes on where the
  // joint is the same, and else starts at 0.
  void begin_from(const RigidBody &was);

  // Half a step's change of velocity, over the time h, by what acts beside the drive. The damper's part is exact. At a
  // stop the body takes up no velocity into it.
  void kick(Real h, const Wrench &load);
  // Moves it over the time h. Where it comes to a stop its velocity is what takes it there in this time, until the next
  // kick().
  void drift(Real h);

  const MassProperties &mass() const { return mass_; }
  const Joint &joint() const { return joint_; }
  Vec3 centre() const { return state_.centre; }
  const Quaternion &turn() const { return state_.turn; }
  Vec3 velocity() const;    // of the centre
  Vec3 omega() const;
  Vec3 angular_momentum() const;    // about the centre
  // Of hinge and slider; else 0.
  Real coordinate() const { return joint_.has_coordinate() ? state_.coordinate[0] : 0; }
  Real rate() const { return joint_.has_coordinate() ? state_.rate[0] : 0; }
  Real kinetic_energy() const;
  Real spring_energy() const;

  // Returns where the mesh is, with velocities for contacts.
  Pose pose() const;
  Mobility mobility() const;
  // Returns the mobility() of the body without stops: no push finds the body easier to move.
  Mobility free_mobility() const;
  // Does the load, with the drive, press the body at rest into a stop?
  bool is_held(const Wrench &load) const;
  // Force (torque) of a stop along (about) the axis of the joint: what holds the body there, and mass (moment of
  // inertia) times the speed that the last drift() has taken from it, over the time of that.
  Real stop_force(const Wrench &load) const;
  // Force and torque of the joint that hold the body, with the velocity that it has now: not spring, damper, motor and
  // stop, which act beside them. The torque is about pivot().
  Wrench reaction(const Wrench &load) const;
  Vec3 pivot() const;    // the joint's point, or the centre of mass
  // Is the mesh, in all that the joint allows, as its file has it along this unit vector: not moved along it, and turned about
  // nothing but it? `length`: by whose rounding places may differ.
  bool keeps(const Vec3 &direction, Real length) const;
  Vec3 axis_in_mesh() const { return rotate(inverse(state_.home_turn), joint_.axis); }

  const RigidState &state() const { return state_; }
  // Goes on as a body of the same mass and joint was.
  void set_state(const RigidState &state);

 private:
  void make_constants();
  void take_velocity(const Vec3 &velocity, const Vec3 &omega);
  Vec3 allowed_turn(const Vec3 &velocity, const Vec3 &omega) const;
  void place();
  Vec3 apply(const SymmetricMatrix &in_mesh, const Vec3 &a) const;
  Vec3 arm_of_point() const;
  Vec3 velocity_of_pivot() const;
  Real driven() const;
  Real along_coordinate(const Wrench &load) const;
  bool is_barred(int direction) const;
  Vec3 spin_up() const;
  void turn_freely(Real h);

  MassProperties mass_;    // in the frame of the mesh
  Joint joint_;
  RigidState state_;
  Real blow_ = 0;    // of a stop, in the last drift(): stop_force()

  // About the joint's point (hinge, ball) or the centre, in the frame of the mesh.
  SymmetricMatrix inertia_, inverse_;
  PrincipalAxes principal_ = {};
  Real inertia_of_axis_ = 0;    // of the first rate: a moment, or the mass
  Vec3 in_plane_[2] = {};       // of planar
};

}    // namespace lsdcd
