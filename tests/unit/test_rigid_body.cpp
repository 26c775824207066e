// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rigid bodies, free and in joints, against closed forms.
#include "motion/motion.h"
#include "rigid/rigid_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace lsdcd::test_rigid_body {
namespace {

constexpr Real kG = 9.81;

using Load = std::function<Wrench(const RigidBody &)>;

void step(RigidBody &body, Real dt, const Load &load)
{
  body.kick(dt / 2, load(body));
  body.drift(dt);
  body.kick(dt / 2, load(body));
}

Wrench nothing(const RigidBody &)
{
  return {};
}

Wrench weight(const RigidBody &body)
{
  const Vec3 f = {0, 0, -kG * body.mass().mass};
  return {f, cross(body.centre(), f)};
}

// I = diag(a, b, c) about the centre.
MassProperties block(Real mass, const Vec3 &moments, const Vec3 &centre = {0, 0, 0})
{
  MassProperties p;
  p.mass = mass;
  p.centre = centre;
  p.inertia = {moments.x, moments.y, moments.z, 0, 0, 0};
  return p;
}

// A square plate of mass 1, its hinge along y through the origin at its edge; it hangs at 0.
constexpr Real kSide = 0.2, kThick = 0.002;
RigidBody flap()
{
  const Real about_edge = kSide * kSide / 12;
  const MassProperties plate =
      block(1, {about_edge + kSide * kSide / 12, about_edge + kThick * kThick / 12, about_edge},
            {0, 0, -kSide / 2});
  return RigidBody(plate, {JointKind::hinge, {0, 0, 0}, {0, 1, 0}});
}
// Of the same plate: I about the hinge.
const Real kFlapInertia = kSide * kSide / 3 + kThick * kThick / 12;

RigidBody released_at(Real angle)
{
  RigidBody body = flap();
  RigidState state = body.state();
  state.coordinate[0] = angle;
  body.set_state(state);
  body.drift(0);
  return body;
}

// The time between the first and the last upward crossing of zero, over their number less 1.
Real period_of(const std::function<Real()> &next, Real dt, int cycles)
{
  Real before = next(), first = 0;
  int seen = 0;
  for (int n = 1;; n++) {
    const Real now = next();
    if (before < 0 && now >= 0) {
      const Real at = (n - 1 + before / (before - now)) * dt;
      if (seen++ == 0) first = at;
      if (seen == cycles + 1) return (at - first) / cycles;
    }
    before = now;
  }
}

Vec3 in_mesh(const RigidBody &body, const Vec3 &a)
{
  return rotate(inverse(body.turn()), a);
}

RigidBody lamina()
{
  RigidBody body(block(1, {1, 2, 3}), Joint());
  body.set_velocity({0, 0, 0}, {0.01, 1, 0.01});
  return body;
}

const Joint kJoints[] = {{JointKind::free, {}, {0, 0, 1}},
                         {JointKind::hinge, {0.3, -0.2, 0.1}, {0.6, 0, 0.8}},
                         {JointKind::slider, {}, {0.6, 0, 0.8}},
                         {JointKind::planar, {}, {0, 0.6, 0.8}},
                         {JointKind::ball, {0.3, -0.2, 0.1}, {0, 0, 1}}};

const char *name_of(const Joint &joint)
{
  return kJointNames[static_cast<int>(joint.kind)];
}

// A body in the middle of its motion, without a principal axis along any joint.
RigidBody moving(const Joint &joint)
{
  MassProperties p = block(2, {0.5, 0.7, 0.9}, {0.1, 0.2, 0.3});
  p.inertia.xy = 0.1;
  p.inertia.xz = -0.05;
  p.inertia.yz = 0.08;
  RigidBody body(p, joint);
  const Wrench push = {{1, -2, 3}, {0.4, 0.5, -0.6}};
  body.kick(1, push);
  for (int n = 0; n < 100; n++) body.drift(0.01);
  return body;
}

struct Velocities {
  Vec3 centre, turn;
};

// a + s b
Velocities sum(const Velocities &a, Real s, const Velocities &b)
{
  return {a.centre + s * b.centre, a.turn + s * b.turn};
}

Velocities velocities_of(const RigidBody &body)
{
  return {body.velocity(), body.omega()};
}

// m v.v' + omega.I omega', with the inertia of the mesh's frame: twice the kinetic energy of one velocity.
Real metric(const RigidBody &body, const Velocities &a, const Velocities &b)
{
  return body.mass().mass * dot(a.centre, b.centre) +
         dot(in_mesh(body, a.turn), body.mass().inertia * in_mesh(body, b.turn));
}

// The velocities that a joint allows a body there, as many as it has degrees of freedom.
std::vector<Velocities> allowed_by(const Joint &joint, const Vec3 &centre)
{
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none = {0, 0, 0}, &n = joint.axis;
  const auto about = [&](const Vec3 &axis) {
    return Velocities{cross(axis, centre - joint.point), axis};
  };
  std::vector<Velocities> all;
  switch (joint.kind) {
    case JointKind::free:
      for (const Vec3 &a : axes) all.insert(all.end(), {{a, none}, {none, a}});
      break;
    case JointKind::hinge:
      return {about(n)};
    case JointKind::slider:
      return {{n, none}};
    case JointKind::planar:    // any two of these span the plane
      for (const Vec3 &a : {axes[0], axes[1]}) all.push_back({a - dot(a, n) * n, none});
      all.push_back({none, n});
      break;
    case JointKind::ball:
      for (const Vec3 &a : axes) all.push_back(about(a));
  }
  return all;
}

// Where the difference has no part, in the metric, along anything that is allowed: Gram and Schmidt's way.
Velocities projected(const RigidBody &body, const Velocities &of, std::vector<Velocities> allowed)
{
  Velocities result = {};
  for (std::size_t i = 0; i < allowed.size(); i++) {
    Velocities &a = allowed[i];
    for (std::size_t j = 0; j < i; j++) a = sum(a, -metric(body, a, allowed[j]), allowed[j]);
    a = sum(Velocities(), 1 / std::sqrt(metric(body, a, a)), a);
    result = sum(result, metric(body, of, a), a);
  }
  return result;
}

}    // namespace

// The closed form is 4 K(k) / rate for Euler's equations (Landau and Lifshitz, Mechanics, section 37).
TEST(rigid_body, tumbles_with_the_period_of_the_closed_form)
{
  RigidBody body = lamina();
  const Real dt = 0.005, period = period_of(
                             [&] {
                               step(body, dt, nothing);
                               return in_mesh(body, body.omega()).y;
                             },
                             dt, 5);
  EXPECT_NEAR(period, 39.1057,
              1e-4);    // its last digit, and as much for the scheme, whose error is 4e-5
}

TEST(rigid_body, keeps_energy_torque_free_and_its_error_falls_as_dt_squared)
{
  Real error[2] = {};
  for (int k = 0; k < 2; k++) {
    RigidBody body = lamina();
    const Real dt = k == 0 ? 0.005 : 0.0025, energy = body.kinetic_energy();
    const int steps = 200000;
    Real early = 0;
    for (int n = 0; n < steps; n++) {
      step(body, dt, nothing);
      error[k] = std::max(error[k], std::fabs(body.kinetic_energy() / energy - 1));
      if (n == steps / 10) early = error[k];
    }
    // 25 (12) periods: the first tenth has seen all of one.
    EXPECT_LT(error[k], 1.001 * early + 1e-12);
    EXPECT_LT(error[k], 1e-4);
  }
  EXPECT_NEAR(error[0] / error[1], 4, 0.01);
}

// From what the pose says: R I R' omega, which the scheme does not keep by itself.
TEST(rigid_body, keeps_angular_momentum_in_space_torque_free)
{
  RigidBody body = lamina();
  const Vec3 before = body.angular_momentum();
  Real worst = 0;
  for (int n = 0; n < 200000; n++) {
    body.drift(0.005);
    if (n % 100) continue;
    const Pose pose = body.pose();
    const Vec3 w = pose.turn_to_mesh(pose.angular), l = {1 * w.x, 2 * w.y, 3 * w.z};
    worst = std::max(worst, norm(pose.turn_to_box(l) - before) / norm(before));
  }
  EXPECT_LT(worst, 1e-12);
}

// 2/pi K(sin 45 degrees) = 1.180341 times 2 pi sqrt(I / (m g s/2)) = 0.73251, the period of a small swing.
TEST(hinge, swings_with_the_period_of_a_swing_from_90_degrees)
{
  RigidBody body = released_at(kPi / 2);
  const Real dt = 1e-4, period = period_of(
                            [&] {
                              step(body, dt, weight);
                              return body.coordinate();
                            },
                            dt, 10);
  EXPECT_NEAR(period, 0.86461, 2e-5);
}

// Free of its hinge it would fall as the reaction says: F + reaction = M a, from differences of velocities. Spring, damper
// and motor of the joint act beside it.
// What a kind does not have stays from the joint before it, and its words never give it again.
TEST(joint, is_told_from_others_by_what_its_kind_has_alone)
{
  const Vec3 zero = {0, 0, 0}, one = {1, 2, 3}, x = {1, 0, 0}, z = {0, 0, 1};
  for (const auto kind :
       {JointKind::free, JointKind::hinge, JointKind::slider, JointKind::planar, JointKind::ball}) {
    const bool has_point = kind == JointKind::hinge || kind == JointKind::ball,
               has_axis = kind != JointKind::free && kind != JointKind::ball;
    EXPECT_EQ((Joint{kind, zero, z} == Joint{kind, one, z}), !has_point);
    EXPECT_EQ((Joint{kind, zero, z} == Joint{kind, zero, x}), !has_axis);
    EXPECT_FALSE(
        (Joint{kind, zero, z} == Joint{has_point ? JointKind::slider : JointKind::hinge, zero, z}));
  }
}

TEST(reaction, is_what_keeps_each_joint)
{
  for (const Joint &joint : kJoints) {
    RigidBody body = moving(joint);
    Vec3 push = {0, 0, 0}, turn = {0, 0, 0};
    if (joint.has_coordinate()) {
      body.drive.stiffness = 2;
      body.drive.rest = 0.3;
      body.drive.damping = 0.7;
      body.drive.motor = 0.4;
      const Real driven = 0.4 - 2 * (body.coordinate() - 0.3) - 0.7 * body.rate();
      (joint.kind == JointKind::hinge ? turn : push) = driven * joint.axis;
    }
    const Wrench load = {{0.3, 0.2, -5}, {0.1, -0.7, 0.2}};
    const Real h = 1e-5;
    const Wrench r = body.reaction(load);
    RigidBody before = body, after = body;
    after.kick(h / 2, load);
    after.drift(h);
    after.kick(h / 2, load);
    before.kick(-h / 2, load);
    before.drift(-h);
    before.kick(-h / 2, load);
    const Vec3 a = 1 / (2 * h) * (after.velocity() - before.velocity()),
               spin = 1 / (2 * h) * (after.angular_momentum() - before.angular_momentum());
    const Vec3 arm = body.centre() - body.pivot();
    // A central difference has an error of h^2, 1e-10, and a rounding of 1e-16 / h.
    EXPECT_LT(norm(load.force + push + r.force - body.mass().mass * a), 1e-8);
    EXPECT_LT(norm(load.torque_about(body.centre()) + turn + r.torque - cross(arm, r.force) - spin),
              1e-8);
  }
}

TEST(hinge, holds_an_unbalanced_rotor)
{
  MassProperties p = block(1.5, {0.3, 0.4, 0.2}, {0.05, 0, 0.1});
  p.inertia.xz = 0.07;
  const Vec3 point = {0, 0, 0.02};
  RigidBody body(p, {JointKind::hinge, point, {0, 0, 1}});
  const Real w = 20;
  body.set_velocity({0, 0, 0}, {0, 0, w});
  Real tilt = 0, most = 0;
  const Real about_point = p.inertia.xz - p.mass * 0.05 * (0.1 - point.z);
  for (int n = 0; n < 100000; n++) {
    step(body, 1e-4, nothing);
    const Pose pose = body.pose();
    tilt = std::max({tilt, std::fabs(pose.row[2].x), std::fabs(pose.row[2].y)});
    const Vec3 couple = pose.turn_to_mesh(body.reaction({}).torque);
    most = std::max(most, norm(couple - Vec3{0, about_point * w * w, 0}));
  }
  EXPECT_LT(tilt, 1e-12);
  EXPECT_LT(most, 1e-10);
}

TEST(hinge, with_motor_and_damper_comes_to_its_speed)
{
  const Real inertia = 0.3, torque = 2, damping = 0.5, dt = 0.01;
  RigidBody body(block(1, {0.2, 0.4, inertia}), {JointKind::hinge, {0, 0, 0}, {0, 0, 1}});
  body.drive.motor = torque;
  body.drive.damping = damping;
  for (int n = 1; n <= 1000; n++) {
    step(body, dt, nothing);
    const Real closed = torque / damping * (1 - std::exp(-damping * n * dt / inertia));
    ASSERT_NEAR(body.omega().z, closed, 1e-12);
  }
}

TEST(slider, with_spring_and_dashpot_is_the_damped_oscillator)
{
  const Real mass = 2, stiffness = 50, damping = 3, rest = 0.1;
  Real error[2] = {};
  for (int k = 0; k < 2; k++) {
    RigidBody body(block(mass, {1, 1, 1}), {JointKind::slider, {}, {0, 0.6, 0.8}});
    body.drive.stiffness = stiffness;
    body.drive.damping = damping;
    body.drive.rest = rest;
    const Real dt = k == 0 ? 0.002 : 0.001, decay = damping / (2 * mass),
               w = std::sqrt(stiffness / mass - decay * decay);
    for (int n = 1; n * dt < 4.0001; n++) {
      step(body, dt, nothing);
      const Real t = n * dt, x = rest - rest * std::exp(-decay * t) *
                                            (std::cos(w * t) + decay / w * std::sin(w * t));
      error[k] = std::max(error[k], std::fabs(body.coordinate() - x));
      EXPECT_LT(norm(body.centre() - body.coordinate() * Vec3{0, 0.6, 0.8}), 1e-15);
    }
  }
  EXPECT_LT(error[0], 1e-5);
  EXPECT_NEAR(error[0] / error[1], 4, 0.05);    // second order with the damper, too
}

TEST(slider, stops_at_a_limit_and_leaves_it)
{
  RigidBody body(block(1, {1, 1, 1}), {JointKind::slider, {}, {0, 0, 1}});
  body.drive.lo = -0.5;
  for (int n = 0; n < 1000; n++) step(body, 1e-3, weight);
  EXPECT_EQ(body.coordinate(), -0.5);
  EXPECT_EQ(body.rate(), 0);    // though its weight presses it on
  body.drive.motor = 2 * kG;
  const int n = 100;
  for (int k = 0; k < n; k++) step(body, 1e-3, weight);
  EXPECT_NEAR(body.coordinate(), -0.5 + 0.5 * kG * 0.1 * 0.1, 2 * kG * 1e-3 * 0.1);
}

// It is driven from stop to stop and pressed on each: what motor and stops give in all steps is the momentum that it has
// in the middle of the next one, to the rounding of a thousand steps.
TEST(stop, takes_the_momentum_that_the_body_loses)
{
  const Real dt = 1e-3;
  for (const JointKind kind : {JointKind::slider, JointKind::hinge}) {
    RigidBody body(block(2, {1, 1, 1}), {kind, {0.3, 0, 0}, {0, 0.6, 0.8}});
    const Real inertia = kind == JointKind::slider ? 2 : 1 + 2 * 0.3 * 0.3;
    body.drive.lo = -0.01;
    body.drive.hi = 0.02;
    Real given = 0, hardest = 0;
    int held = 0;
    for (int n = 0; n < 1030; n++) {
      body.kick(dt / 2, {});
      body.drift(dt);
      body.drive.motor = n / 100 % 2 ? -40 : 40;
      body.kick(dt / 2, {});
      held += body.is_held({});
      hardest = std::max(hardest, std::fabs(body.stop_force({})));
      given += (body.drive.motor + body.stop_force({})) * dt;
    }
    body.kick(dt / 2, {});
    EXPECT_GT(held, 300);
    EXPECT_GT(hardest, 400);    // it strikes
    EXPECT_GT(std::fabs(body.rate()), 0.1);
    EXPECT_NEAR(given, inertia * body.rate(), 1e-12);
  }
}

// A rod of weight 1 hangs out from a hinge at its end, and lies on its stop: the hinge bears all of its force, and none
// of the moment about its axis.
TEST(stop, bears_a_moment_and_the_hinge_the_weight_of_a_body_at_rest)
{
  const Real length = 0.4, mass = 1 / kG;
  RigidBody body(block(mass, {1e-5, mass * length * length / 12, mass * length * length / 12},
                       {length / 2, 0, 0}),
                 {JointKind::hinge, {0, 0, 0}, {0, 1, 0}});
  body.drive.hi = 0;    // down is forward
  for (int n = 0; n < 10; n++) step(body, 1e-3, weight);
  EXPECT_EQ(body.kinetic_energy(), 0);
  EXPECT_NEAR(body.stop_force(weight(body)), -length / 2, 1e-15);
  const Wrench reaction = body.reaction(weight(body));
  EXPECT_NEAR(reaction.force.z, 1, 1e-15);
  EXPECT_NEAR(norm(reaction.torque), 0, 1e-15);
}

TEST(stop, takes_no_velocity_into_it_from_limits_that_come_to_where_the_body_is)
{
  RigidBody body(block(1, {1, 1, 1}), {JointKind::slider, {}, {0, 0, 1}});
  body.set_velocity({0, 0, 2}, {0, 0, 0});
  body.drift(0.1);
  body.drive.lo = body.coordinate();
  body.hold_at_stop();
  EXPECT_EQ(body.rate(), 2);    // away from it
  body.drive.hi = body.coordinate();
  body.hold_at_stop();
  EXPECT_EQ(body.rate(), 0);
}

TEST(ball, keeps_its_point_and_the_momentum_about_the_vertical)
{
  MassProperties p = block(2, {0.5, 0.7, 0.9}, {0.1, 0.2, 0.3});
  p.inertia.xy = 0.1;
  const Vec3 point = {0.3, -0.2, 0.1};
  RigidBody body(p, {JointKind::ball, point, {0, 0, 1}});
  body.set_velocity({0, 0, 0}, {0.5, -0.3, 2});
  const Real about_z = body.state().momentum.z;
  Real off = 0, lost = 0;
  for (int n = 0; n < 100000; n++) {
    step(body, 1e-3, weight);
    off = std::max(off, norm(body.pose().to_box(point) - point));
    const Vec3 arm = body.centre() - point;
    const Vec3 momentum = body.angular_momentum() + p.mass * cross(arm, body.velocity());
    lost = std::max(lost, std::fabs(momentum.z - about_z));
  }
  EXPECT_LT(off, 1e-14);
  EXPECT_LT(lost, 1e-11);    // 1e5 steps of rounding
}

// A ball joint that swings in a plane is a hinge.
TEST(ball, swings_as_a_hinge_does)
{
  const RigidBody hinged = released_at(1);
  RigidBody body(hinged.mass(), {JointKind::ball, {0, 0, 0}, {0, 0, 1}});
  RigidState state = body.state();
  state.turn = hinged.turn();
  body.set_state(state);
  body.drift(0);
  RigidBody same = hinged;
  for (int n = 0; n < 20000; n++) {
    step(body, 1e-4, weight);
    step(same, 1e-4, weight);
  }
  EXPECT_LT(norm(body.centre() - same.centre()), 1e-11);
}

TEST(planar, stays_in_its_plane)
{
  const Vec3 normal = {0, 0.6, 0.8};
  RigidBody body = moving({JointKind::planar, {}, normal});
  const Vec3 from = body.centre();
  const Wrench push = {{3, -1, 2}, {0.1, 0.3, -0.2}};
  Real off = 0, tilt = 0;
  for (int n = 0; n < 100000; n++) {
    step(body, 1e-3, [&](const RigidBody &) { return push; });
    off = std::max(off, std::fabs(dot(normal, body.centre() - from)) / norm(body.centre() - from));
    tilt = std::max(tilt, norm(body.pose().turn_to_box(normal) - normal));
  }
  EXPECT_LT(off, 1e-13);
  EXPECT_LT(tilt, 1e-13);
}

// Returns what an impulse n at x, both of the mesh, adds to the velocity there along n.
Real gained(const RigidBody &body, const Vec3 &x, const Vec3 &n)
{
  const Pose pose = body.pose();
  const Vec3 at = pose.to_box(x), along = pose.turn_to_box(n);
  const auto speed = [&](const RigidBody &b) {
    return dot(along, b.velocity() + cross(b.omega(), at - b.centre()));
  };
  RigidBody pushed = body;
  pushed.kick(1, {along, cross(at, along)});
  return speed(pushed) - speed(body);
}

// That is n.K n.
TEST(mobility, is_what_an_impulse_does)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> any(-1, 1);
  for (const Joint &joint : kJoints) {
    RigidBody body = moving(joint);
    for (int k = 0; k < 20; k++) {
      const Vec3 x = {any(random), any(random), any(random)},
                 n = unit_vector({any(random), any(random), any(random)});
      EXPECT_NEAR(body.mobility().along(x, n), gained(body, x, n), 1e-13);
    }
  }
}

// The same at a stop, where kick() lets no velocity into it: a push out of the body, against the normal.
TEST(mobility, is_none_to_what_pushes_the_body_into_its_stop)
{
  std::mt19937 random(6);
  std::uniform_real_distribution<Real> any(-1, 1);
  int borne = 0, free = 0;
  for (const Joint &joint : {kJoints[1], kJoints[2]})
    for (const bool upper : {false, true}) {
      RigidBody body = moving(joint);
      body.drive.lo = upper ? -HUGE_VAL : body.coordinate();
      body.drive.hi = upper ? body.coordinate() : HUGE_VAL;
      RigidState at_rest = body.state();
      at_rest.rate[0] = 0;
      body.set_state(at_rest);
      for (int k = 0; k < 20; k++) {
        const Vec3 x = {any(random), any(random), any(random)},
                   n = unit_vector({any(random), any(random), any(random)});
        const Real gives = gained(body, x, -n);
        EXPECT_NEAR(body.mobility().along(x, n), gives, 1e-13);
        (gives == 0 ? borne : free)++;
      }
    }
  EXPECT_GT(borne, 20);
  EXPECT_GT(free, 20);
}

TEST(mobility, is_none_between_two_stops_that_are_one)
{
  RigidBody body = moving(kJoints[1]);
  body.drive.lo = body.drive.hi = body.coordinate();
  body.hold_at_stop();
  EXPECT_FALSE(body.mobility().any());
  EXPECT_TRUE(body.free_mobility().any());
}

// Velocities of the pose are the derivatives of places, and its accelerations those of velocities.
TEST(pose_of_a_body, has_the_derivatives_of_its_places)
{
  for (const Joint &joint : kJoints) {
    const RigidBody body = moving(joint);
    const Real h = 1e-4;
    RigidBody before = body, after = body;
    before.drift(-h);
    after.drift(h);
    const Pose now = body.pose(), a = before.pose(), b = after.pose();
    for (const Vec3 &x : {Vec3{0, 0, 0}, Vec3{1, -2, 0.5}}) {
      const Vec3 v = 1 / (2 * h) * (b.to_box(x) - a.to_box(x));
      EXPECT_LT(norm(v - now.turn_to_box(now.velocity_in_mesh(x))), 1e-6);    // h^2 and more
    }
    EXPECT_LT(norm(1 / (2 * h) * (b.velocity - a.velocity) - now.acceleration), 1e-6);
    EXPECT_LT(norm(1 / (2 * h) * (b.angular - a.angular) - now.spin_up), 1e-6);
  }
}

// All joints of a body that turns about an axis through its centre and moves along that: nothing is lost.
TEST(rigid_body, goes_on_in_another_joint_without_a_jump)
{
  RigidBody body(block(2, {0.5, 0.7, 0.9}, {0.1, 0.2, 0.3}), Joint());
  body.set_velocity({0, 0, 0}, {0, 0, 3});
  for (int n = 0; n < 100; n++) body.drift(0.01);
  for (const Joint &joint :
       {Joint{JointKind::hinge, {0.1, 0.2, 0}, {0, 0, 1}}, Joint{JointKind::planar, {}, {0, 0, 1}},
        Joint{JointKind::ball, {0.1, 0.2, 0}, {0, 0, 1}}, Joint()}) {
    const Pose was = body.pose();
    RigidBody next(body.mass(), joint);
    next.begin_from(body);
    body = next;
    body.drift(0);    // where its coordinates say
    const Pose is = body.pose();
    EXPECT_LT(norm(is.shift - was.shift), 1e-15);
    EXPECT_LT(norm(is.row[0] - was.row[0]), 1e-15);
    EXPECT_LT(norm(body.omega() - Vec3{0, 0, 3}), 1e-14);
    for (int n = 0; n < 10; n++) body.drift(0.01);
  }
}

// As after a restart with another mass: each place of the mesh is where it was and has the velocity that it had.
TEST(rigid_body, goes_on_with_another_centre_of_mass_without_a_jump)
{
  RigidBody body(block(2, {0.5, 0.7, 0.9}, {0.1, 0.2, 0.3}), Joint());
  body.set_velocity({1, -2, 0.5}, {0.3, -0.4, 3});
  for (int n = 0; n < 100; n++) body.drift(0.01);
  RigidBody next(block(3, {1, 1.2, 0.8}, {-0.4, 0.1, 0.2}), Joint());
  next.begin_from(body);
  const Pose was = body.pose(), is = next.pose();
  EXPECT_LT(norm(is.shift - was.shift), 1e-14);
  EXPECT_LT(norm(is.row[0] - was.row[0]), 1e-14);
  EXPECT_LT(norm(is.velocity - was.velocity), 1e-14);
  EXPECT_LT(norm(is.angular - was.angular), 1e-14);
}

// Velocities are about 3 and energies about 20, each a sum of some ten products.
TEST(rigid_body, has_in_another_joint_the_velocity_that_is_nearest_in_energy)
{
  const RigidBody body = moving(Joint());
  const Velocities before = velocities_of(body);
  for (const Joint &joint : kJoints) {
    RigidBody next(body.mass(), joint);
    next.begin_from(body);
    const Velocities after = velocities_of(next), lost = sum(before, -1, after),
                     nearest = projected(body, before, allowed_by(joint, body.centre()));
    EXPECT_LT(norm(after.centre - nearest.centre), 1e-14) << name_of(joint);
    EXPECT_LT(norm(after.turn - nearest.turn), 1e-14) << name_of(joint);
    EXPECT_NEAR(body.kinetic_energy() - next.kinetic_energy(), metric(body, lost, lost) / 2, 1e-13)
        << name_of(joint);
  }
}

// A cube of mass 1 and side 1 spins about its centre, and is caught at the distance 3: L = I omega, over I + m 3^2.
TEST(rigid_body, keeps_its_angular_momentum_about_the_point_that_is_caught)
{
  RigidBody body(block(1, {1 / 6., 1 / 6., 1 / 6.}), Joint());
  body.set_velocity({0, 0, 0}, {0, 0, 1});
  const Vec3 point = {0, 3, 0};
  for (const Joint &joint :
       {Joint{JointKind::ball, point, {0, 0, 1}}, Joint{JointKind::hinge, point, {0, 0, 1}}}) {
    RigidBody next(body.mass(), joint);
    next.begin_from(body);
    EXPECT_NEAR(next.omega().z, 1 / 55., 1e-16);
    EXPECT_NEAR(next.kinetic_energy(), 1 / 12. / 55, 1e-16);
  }
  RigidBody passing(block(1, {1 / 6., 1 / 6., 1 / 6.}), Joint());
  passing.set_velocity({1, 0, 0}, {0, 0, 0});
  RigidBody caught(passing.mass(), {JointKind::ball, point, {0, 0, 1}});
  caught.begin_from(passing);
  EXPECT_NEAR(caught.omega().z, 3 / (1 / 6. + 9), 1e-16);    // L = 3 m v
}

// A state is all that goes from one body to another of the same mass and joint, as after a restart: the arm of the joint's point
// in the body, and so its inertia, are those of where it was when it got the joint.
TEST(rigid_body, goes_on_from_the_state_of_another_to_the_last_bit)
{
  for (const Joint &joint : kJoints) {
    const RigidBody before = moving(Joint());
    RigidBody one(before.mass(), joint);
    one.begin_from(before);
    RigidBody other(before.mass(), joint);
    other.set_state(one.state());
    for (RigidBody *body : {&one, &other})
      for (int n = 0; n < 10; n++) step(*body, 0.01, weight);
    EXPECT_TRUE(one.centre() == other.centre() && one.velocity() == other.velocity() &&
                one.omega() == other.omega() && one.turn().v == other.turn().v)
        << name_of(joint);
    EXPECT_EQ(one.kinetic_energy(), other.kinetic_energy());
    const Vec3 x = {0.3, -0.1, 0.7}, n = {0.6, 0, 0.8};
    EXPECT_EQ(one.mobility().along(x, n), other.mobility().along(x, n));
  }
}

// As after a restart with another density: back by its coordinate the mesh is where it began.
TEST(rigid_body, keeps_its_coordinate_in_the_same_joint_with_another_mass)
{
  for (const Joint &joint : kJoints) {
    if (!joint.has_coordinate()) continue;
    const RigidBody body = moving(joint);
    RigidBody next(block(3, {1, 1.2, 0.8}, {-0.4, 0.1, 0.2}), joint);
    next.begin_from(body);
    EXPECT_EQ(next.coordinate(), body.coordinate());
    EXPECT_NEAR(next.rate(), body.rate(), 1e-14 * std::fabs(body.rate()));
    EXPECT_LT(norm(next.pose().shift - body.pose().shift), 1e-14);
    next.drift(-next.coordinate() / next.rate());
    EXPECT_LT(norm(next.pose().shift), 1e-14) << name_of(joint);
    EXPECT_LT(norm(next.pose().row[0] - Vec3{1, 0, 0}), 1e-14) << name_of(joint);
  }
}

TEST(rigid_body, refuses_a_velocity_that_its_joint_does_not_allow)
{
  RigidBody body(block(1, {1, 1, 1}), {JointKind::slider, {}, {1, 0, 0}});
  EXPECT_NO_THROW(body.set_velocity({2, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(body.velocity().x, 2);
  EXPECT_ANY_THROW(body.set_velocity({2, 0.1, 0}, {0, 0, 0}));
  EXPECT_ANY_THROW(body.set_velocity({2, 0, 0}, {0, 0, 0.1}));
}

}    // namespace lsdcd::test_rigid_body
