// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "rigid/rigid_body.h"

#include "base/input_error.h"
#include "base/vector_text.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// The rate after the time h under a constant force against a damper, exactly.
Real kicked(Real rate, Real force, Real mass, Real damping, Real h)
{
  if (damping == 0) return rate + h * force / mass;
  const Real decay = -damping * h / mass;
  return rate * std::exp(decay) - force / damping * std::expm1(decay);
}

}    // namespace

RigidBody::RigidBody(const MassProperties &mass, const Joint &joint) : mass_(mass), joint_(joint)
{
  state_.home = state_.centre = mass.centre;
  make_constants();
}

void RigidBody::make_constants()
{
  inertia_ = mass_.inertia;
  if (joint_.has_point()) inertia_ += mass_.mass * inertia_of_point(arm_of_point());
  inverse_ = function_of(inertia_, [](Real moment) { return 1 / moment; });
  principal_ = principal_axes(inertia_);
  const Vec3 axis = axis_in_mesh();
  inertia_of_axis_ = joint_.kind == JointKind::slider ? mass_.mass : dot(axis, inertia_ * axis);
  in_plane_[0] = any_perpendicular(joint_.axis);
  in_plane_[1] = cross(joint_.axis, in_plane_[0]);
}

// Takes velocities that the joint allows.
void RigidBody::take_velocity(const Vec3 &velocity, const Vec3 &omega)
{
  const Vec3 &a = joint_.axis;
  RigidState &s = state_;
  switch (joint_.kind) {
    case JointKind::free:
      s.velocity = velocity;
      s.momentum = apply(inertia_, omega);
      return;
    case JointKind::ball:
      s.momentum = apply(inertia_, omega);
      return;
    case JointKind::hinge:
      s.rate[0] = dot(a, omega);
      return;
    case JointKind::slider:
      s.rate[0] = dot(a, velocity);
      return;
    case JointKind::planar:
      for (int k = 0; k < 2; k++) s.rate[k] = dot(in_plane_[k], velocity);
      s.rate[2] = dot(a, omega);
  }
}

void RigidBody::set_velocity(const Vec3 &velocity, const Vec3 &omega)
{
  take_velocity(velocity, omega);
  // A turn about a point moves the centre, which need not be said.
  const Vec3 v = joint_.has_point() && norm_sq(velocity) == 0 ? Vec3{0, 0, 0}
                                                              : this->velocity() - velocity,
             w = this->omega() - omega;
  constexpr Real kRounding = 1e-9;    // of axes with ten digits
  if (norm(v) > kRounding * norm(velocity) || norm(w) > kRounding * norm(omega))
    throw InputError("the joint does not allow the velocity " + vector_text(velocity) +
                     " of the centre with the angular velocity " + vector_text(omega));
}

// Returns the angular velocity that is left where the joint takes hold of a body that moves so: an impulse of the joint has
// no power in the motions that it allows, so that the momentum along these stays.
Vec3 RigidBody::allowed_turn(const Vec3 &velocity, const Vec3 &omega) const
{
  const Vec3 momentum = apply(mass_.inertia, omega) +
                        mass_.mass * cross(state_.centre - pivot(), velocity);    // about pivot()
  switch (joint_.kind) {
    case JointKind::ball:
      return apply(inverse_, momentum);
    case JointKind::hinge:
    case JointKind::planar:
      return dot(joint_.axis, momentum) / inertia_of_axis_ * joint_.axis;
    default:    // free: all of it; slider: not read
      return omega;
  }
}

void RigidBody::begin_from(const RigidBody &was)
{
  const RigidState &at = was.state();
  RigidState now;
  now.centre = was.pose().to_box(mass_.centre);
  now.turn = at.turn;
  if (joint_ == was.joint() && joint_.has_coordinate()) {
    now.home = at.home + rotate(at.home_turn, mass_.centre - was.mass().centre);
    now.home_turn = at.home_turn;
    now.coordinate[0] = at.coordinate[0];
  } else {
    now.home = now.centre;
    now.home_turn = now.turn;
  }
  set_state(now);
  const Vec3 w = was.omega(), v = was.velocity() + cross(w, now.centre - was.centre());
  take_velocity(v, allowed_turn(v, w));
}

void RigidBody::set_state(const RigidState &state)
{
  state_ = state;
  make_constants();
}

// ---- stops -------------------------------------------------------------------------------

// Is the body at a stop that bars its way in this direction of the coordinate, 1 or -1?
bool RigidBody::is_barred(int direction) const
{
  if (!joint_.has_coordinate()) return false;
  return direction > 0 ? coordinate() >= drive.hi : coordinate() <= drive.lo;
}

void RigidBody::hold_at_stop()
{
  Real &rate = state_.rate[0];
  if ((rate > 0 && is_barred(1)) || (rate < 0 && is_barred(-1))) rate = 0;
}

bool RigidBody::is_held(const Wrench &load) const
{
  if (!joint_.has_coordinate() || state_.rate[0] != 0) return false;
  const Real pressed = along_coordinate(load) + driven();
  return pressed != 0 && is_barred(pressed > 0 ? 1 : -1);
}

Real RigidBody::stop_force(const Wrench &load) const
{
  return is_held(load) ? blow_ - (along_coordinate(load) + driven()) : blow_;
}

// ---- a step ------------------------------------------------------------------------------

// Of spring, damper and motor, along the coordinate.
Real RigidBody::driven() const
{
  return drive.motor - drive.stiffness * (state_.coordinate[0] - drive.rest) -
         drive.damping * state_.rate[0];
}

Real RigidBody::along_coordinate(const Wrench &load) const
{
  return dot(joint_.axis,
             joint_.kind == JointKind::hinge ? load.torque_about(pivot()) : load.force);
}

void RigidBody::kick(Real h, const Wrench &load)
{
  const Vec3 &a = joint_.axis;
  RigidState &s = state_;
  const Vec3 torque = load.torque_about(pivot());
  switch (joint_.kind) {
    case JointKind::free:
      s.velocity += h / mass_.mass * load.force;
      s.momentum += h * torque;
      return;
    case JointKind::ball:
      s.momentum += h * torque;
      return;
    case JointKind::planar:
      for (int k = 0; k < 2; k++) s.rate[k] += h / mass_.mass * dot(in_plane_[k], load.force);
      s.rate[2] += h / inertia_of_axis_ * dot(a, torque);
      return;
    case JointKind::hinge:
    case JointKind::slider: {
      const Real spring = -drive.stiffness * (s.coordinate[0] - drive.rest);
      s.rate[0] = kicked(s.rate[0], along_coordinate(load) + drive.motor + spring, inertia_of_axis_,
                         drive.damping, h);
      hold_at_stop();
    }
  }
}

void RigidBody::drift(Real h)
{
  RigidState &s = state_;
  switch (joint_.kind) {
    case JointKind::free:
      s.centre += h * s.velocity;
      turn_freely(h);
      return;
    case JointKind::ball:
      turn_freely(h);
      break;
    case JointKind::planar:
      for (int k = 0; k < 3; k++) s.coordinate[k] += h * s.rate[k];
      break;
    case JointKind::hinge:
    case JointKind::slider: {
      const Real next = s.coordinate[0] + h * s.rate[0],
                 allowed = std::max(drive.lo, std::min(drive.hi, next));
      blow_ = 0;
      if (allowed != next) {
        blow_ = -inertia_of_axis_ * s.rate[0] / h;
        s.rate[0] = (allowed - s.coordinate[0]) / h;
      }
      s.coordinate[0] = allowed;
    }
  }
  place();
}

// Where the coordinates say.
void RigidBody::place()
{
  const Vec3 &a = joint_.axis, &p = joint_.point;
  RigidState &s = state_;
  switch (joint_.kind) {
    case JointKind::free:
      return;
    case JointKind::ball:
      s.centre = p - rotate(s.turn, arm_of_point());
      return;
    case JointKind::hinge: {
      const Quaternion turn = rotation_about(a, s.coordinate[0]);
      s.turn = turn * s.home_turn;
      s.centre = p + rotate(turn, s.home - p);
      return;
    }
    case JointKind::slider:
      s.centre = s.home + s.coordinate[0] * a;
      return;
    case JointKind::planar:
      s.turn = rotation_about(a, s.coordinate[2]) * s.home_turn;
      s.centre = s.home + s.coordinate[0] * in_plane_[0] + s.coordinate[1] * in_plane_[1];
  }
}

// Turns about principal axes in turn, each of which is the exact motion of a part of the kinetic energy: symplectic,
// and the angular momentum in space is not touched. Dullweber, Leimkuhler and McLachlan, J. Chem. Phys. 107 (1997)
// 5840; McLachlan, SIAM J. Sci. Comput. 16 (1995) 151.
void RigidBody::turn_freely(Real h)
{
  const PrincipalAxes &p = principal_;
  const Vec3 in_mesh = rotate(inverse(state_.turn), state_.momentum);
  Vec3 l = {dot(p.axis[0], in_mesh), dot(p.axis[1], in_mesh), dot(p.axis[2], in_mesh)};
  Quaternion turned;
  const auto turn = [&](int i, Real time) {
    const Real angle = time * l[i] / p.value[i], s = std::sin(angle), c = std::cos(angle);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Real at_j = l[j], at_k = l[k];
    l[j] = c * at_j + s * at_k;
    l[k] = c * at_k - s * at_j;
    turned = turned * rotation_about(p.axis[i], angle);
  };
  turn(0, h / 2);
  turn(1, h / 2);
  turn(2, h);
  turn(1, h / 2);
  turn(0, h / 2);
  state_.turn = normalised(state_.turn * turned);
}

// ---- what it does ------------------------------------------------------------------------

// The product of a tensor of the mesh's frame and a vector of the box, in the box.
Vec3 RigidBody::apply(const SymmetricMatrix &in_mesh, const Vec3 &a) const
{
  return rotate(state_.turn, in_mesh * rotate(inverse(state_.turn), a));
}

bool RigidBody::keeps(const Vec3 &direction, Real length) const
{
  constexpr Real kRounding = 1e-12;    // of unit vectors
  return joint_.keeps(direction) &&
         norm(rotate(state_.home_turn, direction) - direction) <= kRounding &&
         std::fabs(dot(state_.home - mass_.centre, direction)) <= kRounding * length;
}

// From the centre to the joint's point, in the frame of the mesh.
Vec3 RigidBody::arm_of_point() const
{
  return rotate(inverse(state_.home_turn), joint_.point - state_.home);
}

Vec3 RigidBody::pivot() const
{
  return joint_.has_point() ? joint_.point : state_.centre;
}

Vec3 RigidBody::velocity_of_pivot() const
{
  const RigidState &s = state_;
  switch (joint_.kind) {
    case JointKind::free:
      return s.velocity;
    case JointKind::slider:
      return s.rate[0] * joint_.axis;
    case JointKind::planar:
      return s.rate[0] * in_plane_[0] + s.rate[1] * in_plane_[1];
    default:
      return {0, 0, 0};
  }
}

Vec3 RigidBody::velocity() const
{
  return velocity_of_pivot() + cross(omega(), state_.centre - pivot());
}

Vec3 RigidBody::omega() const
{
  const RigidState &s = state_;
  switch (joint_.kind) {
    case JointKind::free:
    case JointKind::ball:
      return apply(inverse_, s.momentum);
    case JointKind::hinge:
      return s.rate[0] * joint_.axis;
    case JointKind::planar:
      return s.rate[2] * joint_.axis;
    default:
      return {0, 0, 0};
  }
}

Vec3 RigidBody::angular_momentum() const
{
  return joint_.kind == JointKind::free ? state_.momentum : apply(mass_.inertia, omega());
}

Real RigidBody::kinetic_energy() const
{
  return 0.5 * (mass_.mass * norm_sq(velocity()) + dot(omega(), angular_momentum()));
}

Real RigidBody::spring_energy() const
{
  const Real stretch = state_.coordinate[0] - drive.rest;
  return joint_.has_coordinate() ? 0.5 * drive.stiffness * stretch * stretch : 0;
}

// The derivative of omega while nothing acts.
Vec3 RigidBody::spin_up() const
{
  if (joint_.kind != JointKind::free && joint_.kind != JointKind::ball) return {0, 0, 0};
  return -apply(inverse_, cross(omega(), state_.momentum));
}

Pose RigidBody::pose() const
{
  Pose pose;
  rows_of(state_.turn, pose.row);
  pose.shift = state_.centre - rotate(state_.turn, mass_.centre);
  pose.placed = true;
  const Vec3 w = omega(), arm = pose.shift - pivot();
  pose.angular = w;
  pose.velocity = velocity_of_pivot() + cross(w, arm);
  pose.spin_up = spin_up();
  pose.acceleration = cross(pose.spin_up, arm) + cross(w, cross(w, arm));
  return pose;
}

Mobility RigidBody::mobility() const
{
  Mobility m = free_mobility();
  const bool up = state_.rate[0] >= 0 && is_barred(1), down = state_.rate[0] <= 0 && is_barred(-1);
  if (up && down) m.shifts = m.turns = SymmetricMatrix();
  if (up != down)
    (joint_.kind == JointKind::hinge ? m.turn_into_stop : m.into_stop) =
        (up ? 1. : -1.) * axis_in_mesh();
  return m;
}

Mobility RigidBody::free_mobility() const
{
  const Vec3 axis = axis_in_mesh();
  const Real per_mass = 1 / mass_.mass;
  Mobility m;
  m.point = mass_.centre;
  switch (joint_.kind) {
    case JointKind::free:
      m.shifts = per_mass * unit_matrix();
      m.turns = inverse_;
      return m;
    case JointKind::ball:
      m.point += arm_of_point();
      m.turns = inverse_;
      return m;
    case JointKind::hinge:
      m.point += arm_of_point();
      m.turns = 1 / inertia_of_axis_ * outer_square(axis);
      return m;
    case JointKind::slider:
      m.shifts = per_mass * outer_square(axis);
      return m;
    case JointKind::planar:
      m.shifts = per_mass * unit_matrix();
      m.shifts += -per_mass * outer_square(axis);
      m.turns = 1 / inertia_of_axis_ * outer_square(axis);
  }
  return m;
}

Wrench RigidBody::reaction(const Wrench &load) const
{
  const Vec3 &a = joint_.axis, &f = load.force;
  const Vec3 torque = load.torque_about(pivot()), w = omega(), arm = state_.centre - pivot(),
             gyration = cross(w, apply(inertia_, w));
  const auto mass_times = [&](const Vec3 &spin_up) {
    return mass_.mass * (cross(spin_up, arm) + cross(w, cross(w, arm)));
  };
  switch (joint_.kind) {
    case JointKind::free:
      return {};
    case JointKind::ball:
      return {mass_times(apply(inverse_, torque - gyration)) - f, {0, 0, 0}};
    case JointKind::hinge: {
      const Real beside = driven() + stop_force(load);
      const Vec3 spin_up = (dot(a, torque) + beside) / inertia_of_axis_ * a;
      return {mass_times(spin_up) - f, apply(inertia_, spin_up) + gyration - torque - beside * a};
    }
    case JointKind::slider:
      return {dot(a, f) * a - f, -torque};
    case JointKind::planar: {
      const Vec3 spin_up = dot(a, torque) / inertia_of_axis_ * a;
      return {-dot(a, f) * a, apply(inertia_, spin_up) + gyration - torque};
    }
  }
  return {};
}

}    // namespace lsdcd
