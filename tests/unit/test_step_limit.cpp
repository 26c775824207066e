// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The longest stable timestep of a body on springs, against closed forms and against its motion.
#include "rigid/rigid_body.h"
#include "rigid/step_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd::test_step_limit {
namespace {

// A square plate of mass 1 and side 0.2 on 100 springs of 1e5, which push it upwards: on a grid from edge to edge.
constexpr Real kMass = 1, kSide = 0.2, kStiffness = 1e5;
constexpr int kRow = 10;

MassProperties plate()
{
  MassProperties p;
  p.mass = kMass;
  const Real moment = kMass * kSide * kSide / 12;
  p.inertia = {moment, moment, 2 * moment, 0, 0, 0};
  return p;
}

std::vector<Vec3> places()
{
  std::vector<Vec3> x;
  for (int i = 0; i < kRow; i++)
    for (int j = 0; j < kRow; j++)
      x.push_back({kSide * (i / (kRow - 1.) - 0.5), kSide * (j / (kRow - 1.) - 0.5), 0});
  return x;
}

Real limit_of(const RigidBody &body)
{
  ContactSum sum;
  const Mobility m = body.mobility();
  for (const Vec3 &x : places()) sum.add(m, x, {0, 0, 1}, kStiffness);
  return longest_step(sum.largest(m), 0);
}

// The largest height that a corner goes to in 2000 steps, from a tilt and a shift of 1e-9.
Real farthest(RigidBody body, Real dt)
{
  body.kick(1, {{0, 0, 1e-6}, {1e-7, 2e-7, 0}});
  Real far = 0;
  for (int n = 0; n < 2000; n++) {
    const Pose pose = body.pose();
    Wrench load;
    for (const Vec3 &x : places()) {
      const Vec3 at = pose.to_box(x), f = {0, 0, -kStiffness * at.z};
      load.force += f;
      load.torque += cross(at, f);
      far = std::max(far, std::fabs(at.z));
    }
    body.kick(dt, load);
    body.drift(dt);
  }
  return far;
}

const RigidBody kSlider(plate(), {JointKind::slider, {}, {0, 0, 1}}), kFree(plate(), Joint());

}    // namespace

TEST(longest_step, of_a_plate_on_springs)
{
  EXPECT_NEAR(limit_of(kSlider), 2 * std::sqrt(kMass / (kRow * kRow * kStiffness)), 1e-15);
  EXPECT_NEAR(limit_of(kSlider), 6.32e-4, 5e-7);
  // Tilted about its middle it is stiffer: the mean of x^2 is 11/9 of a^2 / 12.
  EXPECT_NEAR(limit_of(kFree), 5.72e-4, 5e-7);
}

// K/I is 1e309: no timestep is short enough, and none may pass.
TEST(longest_step, of_a_spring_beyond_all_numbers_is_none)
{
  Mobility body;
  body.turns = {1e6, 1e6, 1e6, 0, 0, 0};
  ContactSum spring;
  spring.add(Vec3{0, 0, 0}, Vec3{0, 0, 1}, 1e303);
  EXPECT_EQ(longest_step(spring.largest(body), 0), 0);
  EXPECT_EQ(longest_step(spring.largest(body), spring.largest(body)), 0);
}

// At the hinge's distance x the eigenvalue is k sum x^2 / I.
TEST(longest_step, of_a_hinged_plate)
{
  const RigidBody hinged(plate(), {JointKind::hinge, {kSide / 2, 0, 0}, {0, 1, 0}});
  Real sum = 0;
  for (const Vec3 &x : places()) sum += (x.x - kSide / 2) * (x.x - kSide / 2);
  const Real inertia = kMass * kSide * kSide / 3;
  EXPECT_NEAR(limit_of(hinged), 2 / std::sqrt(kStiffness * sum / inertia), 1e-15);
}

TEST(longest_step, is_where_leapfrog_becomes_unstable)
{
  for (const RigidBody *body : {&kSlider, &kFree}) {
    const Real limit = limit_of(*body);
    EXPECT_LT(farthest(*body, 0.95 * limit), 1e-7);
    EXPECT_GT(farthest(*body, 1.05 * limit), 1e-3);
  }
}

// x'' = - k x - c x', with the velocity of half a step ago.
TEST(longest_step, is_shorter_where_the_velocity_of_damping_lags)
{
  const Real k = 1e4;
  for (const Real z : {0.05, 0.3, 1.}) {
    const Real c = 2 * z * std::sqrt(k), limit = longest_step(k, c);
    EXPECT_NEAR(limit, 2 / std::sqrt(k) * (std::sqrt(1 + z * z) - z), 1e-15);
    for (const Real share : {0.95, 1.05}) {
      Real x = 1, v = 0, far = 0;
      for (int n = 0; n < 2000; n++) {
        v += share * limit * (-k * x - c * v);
        x += share * limit * v;
        far = std::max(far, std::fabs(x));
      }
      EXPECT_EQ(far < 10, share < 1) << z;
    }
  }
}

}    // namespace lsdcd::test_step_limit
