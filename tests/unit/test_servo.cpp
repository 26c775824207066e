// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loop of a servo: stable on chains of spheres up to the timestep of their contacts.
#include "law/contact_slope.h"
#include "support/motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd::test_servo {
namespace {

Servo servo(Real target, Real max_speed)
{
  Servo s;
  s.present = true;
  s.target = target;
  s.max_speed = max_speed;
  return s;
}

// Equal chains of spheres between a floor and a plate of this servo, as LAMMPS steps them: forces
// at half a step's velocities. Coordinates are displacements upwards from where all just touch and
// nothing opens.
struct Chains {
  int n, parallel;
  Real mass, k, c, dt;    // of one sphere and one contact
  std::vector<Real> u, v, f;
  Real push = 0;

  Chains(int n_, int parallel_, Real mass_, Real k_, Real c_, Real dt_) :
      n(n_), parallel(parallel_), mass(mass_), k(k_), c(c_), dt(dt_), u(n), v(n), f(n)
  {
  }

  void step(Real plate, Real speed)
  {
    for (int i = 0; i < n; i++) {
      v[i] += 0.5 * dt * f[i] / mass;
      u[i] += dt * v[i];
    }
    std::fill(f.begin(), f.end(), 0.0);
    for (int i = 0; i <= n; i++) {
      const Real below = i > 0 ? u[i - 1] : 0, v_below = i > 0 ? v[i - 1] : 0;
      const Real above = i < n ? u[i] : plate, v_above = i < n ? v[i] : speed;
      const Real squeezed = k * (below - above) + c * (v_below - v_above);
      if (i > 0) f[i - 1] -= squeezed;
      if (i < n) f[i] += squeezed;
      push = -parallel * squeezed;    // on the last sphere, upwards
    }
    for (int i = 0; i < n; i++) v[i] += 0.5 * dt * f[i] / mass;
  }
};

// The load stays within what it was and comes to the target, for every chain at a tenth of the
// contact's time and below; what LAMMPS's explicit damping could not bear alone is left out: it
// needs c dt/m < 1/2 of a sphere with two contacts.
TEST(Servo, loop_is_stable_up_to_a_tenth_of_the_contact_time)
{
  const Real k = 1e4, mass = 1, omega = std::sqrt(k / mass);
  int tried = 0;
  for (int n : {1, 2, 8})
    for (int parallel : {1, 100})
      for (Real phase : {0.01, 0.1, 0.314})           // omega dt; a tenth of kPi/omega
        for (Real ratio : {0.03, 0.1, 0.3, 0.7}) {    // of critical damping
          const Real dt = phase / omega, c = 2 * ratio * std::sqrt(k * mass);
          if (c * dt / mass > 0.45) continue;
          // The slowest mode of the column takes longest, damped by the contacts or by the servo.
          const Real slow = kPi / (2 * (n + 1)), rate = std::min(ratio * slow, Real(0.2)) * slow;
          const int steps = static_cast<int>(40 / (rate * phase)) + 100;
          Chains chains(n, parallel, mass, k, c, dt);
          Servo s = servo(-100, 1e3);
          Real early = 0, late = 0;
          for (int t = 0; t < steps; t++) {
            s.advance(chains.push, servo_gain(parallel * k, parallel * c, dt), dt);
            chains.step(s.position, s.velocity);
            const Real off = std::fabs(chains.push - s.target);
            (t < steps / 2 ? early : late) = std::max(t < steps / 2 ? early : late, off);
            if (t == steps - 1) {
              EXPECT_LT(off, 1e-3 * 100)
                  << n << " spheres, " << parallel << " chains, phase " << phase << ", " << ratio;
            }
          }
          EXPECT_LT(late, early) << n << ", " << parallel << ", " << phase << ", " << ratio;
          tried++;
        }
  EXPECT_GT(tried, 50);
}

// The manual's limit for LAMMPS's steps without a servo, for the steepest mode of n spheres between
// walls: 4 sin^2(n pi/(2 (n + 1))) times one contact, and 4 where n is large.
TEST(Servo, chains_alone_are_stable_while_their_damping_is_resolved)
{
  const Real mass = 2, k = 1e4, dt = 1e-3;
  const int n = 8;
  const Real steepest = 4 * std::pow(std::sin(n * kPi / (2 * (n + 1))), 2);
  for (Real times : {0.99, 1.01}) {
    const Real c = (times * 4 / steepest * mass - k * dt * dt) / (2 * dt);
    Chains chains(n, 1, mass, k, c, dt);
    for (int i = 0; i < n; i++) chains.v[i] = i % 2 ? 1 : -1;
    for (int t = 0; t < 2000; t++) chains.step(0, 0);
    if (times < 1)
      EXPECT_LT(std::fabs(chains.v[n / 2]), 1);
    else
      EXPECT_GT(std::fabs(chains.v[n / 2]), 1000);
  }
}

// The oracle is the root of the loop's own quadratic: lambda^2 + lambda (g + d - 1) - d.
TEST(Servo, loop_on_a_fixed_contact_grows_from_four_times_the_gain)
{
  for (Real c : {0.0, 10.0, 300.0}) {
    const Real k = 1e4, dt = 1e-3;
    for (Real times : {3.9, 4.1}) {
      Servo s = servo(-100, 1e9);
      Real push = 0;
      for (int t = 0; t < 2000; t++) {
        s.advance(push, times * servo_gain(k, c, dt), dt);
        push = k * s.position + c * s.velocity;
      }
      if (times < 4)
        EXPECT_LT(std::fabs(push + 100), 1);
      else
        EXPECT_GT(std::fabs(push + 100), 1000);
    }
  }
}

TEST(Servo, moves_at_most_at_its_speed_and_stops_at_its_limits)
{
  Servo s = servo(-100, 0.5);
  s.lo = -0.0125;
  s.hi = 0;
  EXPECT_FALSE(s.advance(0, 1, 0.01));
  EXPECT_EQ(s.velocity, -0.5);
  EXPECT_EQ(s.position, -0.5 * 0.01);
  s.advance(0, 1, 0.01);
  EXPECT_TRUE(s.advance(0, 1, 0.01));
  EXPECT_EQ(s.position, s.lo);
  EXPECT_NEAR(s.velocity, -0.25, 1e-15);    // what was left of the step
  EXPECT_TRUE(s.advance(0, 1, 0.01));
  EXPECT_EQ(s.velocity, 0);
  EXPECT_FALSE(s.advance(-101, 0.1, 0.01));    // pressed back
  EXPECT_NEAR(s.velocity, 0.1, 1e-15);
}

TEST(Servo, pushes_against_what_spheres_exert)
{
  Servo s = servo(1, 1);
  s.axis = {0, 0, 1};
  EXPECT_EQ(s.push({1, 2, 3}, {4, 5, 6}), -3);
  s.turns = true;
  s.point = {10, 20, 30};
  // (4, 5, 6) less (10, 20, 30) x (1, 2, 3) = 0
  EXPECT_EQ(s.push({1, 2, 3}, {4, 5, 6}), -6);
  EXPECT_EQ(s.push({1, 0, 0}, {0, 0, 6}), -26);
}

// It is outermost: a quarter turn about z through (1, 0, 0) of a mesh that has moved by 2 in x.
TEST(Servo, acts_on_what_motions_have_placed)
{
  RigidMotion motion = motion_of({linear({2, 0, 0})});
  motion.servo() = servo(1, 1);
  motion.servo().turns = true;
  motion.servo().point = {1, 0, 0};
  motion.servo().position = std::acos(0.0);
  motion.servo().velocity = 3;
  const Pose pose = motion.pose_at(1);
  const Vec3 at = pose.to_box({5, 0, 1});    // 7 in x, 6 from the axis
  EXPECT_NEAR(norm(at - Vec3{1, 6, 1}), 0, 1e-14);
  // Its own 2 turned into y, and 3 times 6 round the axis.
  const Vec3 speed = pose.turn_to_box(pose.velocity_in_mesh({5, 0, 1}));
  EXPECT_NEAR(norm(speed - Vec3{-18, 2, 0}), 0, 1e-13);
  EXPECT_TRUE(motion.any());
  EXPECT_TRUE(motion.keeps({0, 0, 1}));
  EXPECT_FALSE(motion.keeps({1, 0, 0}));
}

// Derivatives of the force of laws that are written down here once more.
TEST(ContactSlope, is_the_derivative_of_the_force)
{
  const Real overlap = 0.01, radius = 0.5, mass = 2, a = std::sqrt(overlap * radius);
  ContactLaw law;
  law.k_normal = 1e4;
  law.k_tangent = 3e3;
  law.eta = 20;
  law.gamma_tangent = 30;
  ContactSlope s = contact_slope(law, overlap, radius, mass);
  EXPECT_EQ(s.stiffness, 1e4);
  EXPECT_EQ(s.damping, 60);
  law.normal = NormalModel::hertz;    // k sqrt(R) overlap^1.5
  law.tangential = TangentialModel::linear_history_classic;
  s = contact_slope(law, overlap, radius, mass);
  EXPECT_NEAR(s.stiffness, 1.5 * 1e4 * a, 1e-11 * s.stiffness);
  EXPECT_NEAR(s.damping, 60 * a, 1e-11);

  law = granular_law(NormalModel::hooke);
  law.normal = NormalModel::jkr;
  law.modulus = 7.5e3;
  law.k_normal = 1e4;
  law.surface_energy = 5;
  law.damping = DampingModel::mass_velocity;
  law.eta = 7;
  law.xgammat = 2;
  law.tangential = TangentialModel::mindlin;
  law.k_tangent = 8e3;
  s = contact_slope(law, overlap, radius, mass);
  EXPECT_EQ(s.damping, 7 * 2 * 2);
  // JKR by the contact radius x: overlap x^2/R - 2 sqrt(pi g x/E), force 4 E x^3/(3R) - 4 sqrt(pi g E x^3).
  const Real e = 7.5e3, g = 5;
  Real x = a;
  for (int i = 0; i < 200; i++) x = std::sqrt(radius * (overlap + 2 * std::sqrt(kPi * g * x / e)));
  const Real slope = (4 * e * x * x / radius - 6 * std::sqrt(kPi * g * e * x)) /
                     (2 * x / radius - std::sqrt(kPi * g / (e * x)));
  EXPECT_GE(s.stiffness, slope);
  EXPECT_LE(s.stiffness, 3 * slope);
}

}    // namespace
}    // namespace lsdcd::test_servo
