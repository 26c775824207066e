// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Walls whose surface moves: conveyors, turntables, rolls.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_belt {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kMu = 0.3, kG = 10;
constexpr Real kSpeed = 2, kStep = 1e-5;
const Real kLevel = kRadius - kMass * kG / kStiffness;    // of a sphere at rest on z = 0

EngineSettings on_belt(const Vec3 &velocity)
{
  EngineSettings s = hooke(kStiffness, 50, 5000, kMu);
  s.surface.velocity = velocity;
  return s;
}

HardCase belt(const char *id, const char *what)
{
  return {"Belt", id, what};
}

// A sphere put on a belt, in one of many seamed floors; steps until the belt slips under
// it at a hundredth of its speed, and returns that time.
struct Ride {
  explicit Ride(const EngineSettings &settings) : scene(floor_mesh(16, 2, 3), kRadius, settings)
  {
    scene.add_sphere({-1, 0.13, kLevel}, kRadius, kMass);
    scene.compute(kStep, false);
  }
  Real slip() const { return kSpeed - scene.v(0).x + kRadius * scene.omega(0).y; }
  void step()
  {
    scene.step(kStep, {0, 0, -kG});
    if (!turns) scene.set_omega(0, {0, 0, 0});
  }
  Real until_it_grips(Real at_most)
  {
    Real t = 0;
    for (; slip() > 0.01 * kSpeed && t < at_most; t += kStep) step();
    return t;
  }

  Scene scene;
  bool turns = true;
};

// Friction mu m g speeds the sphere up by mu g t and turns it by 5/2 mu g t/R; the slip
// ends after 2u/(7 mu g). It then rolls on the belt with 2u/7 in the lab, for ever:
// nothing but rolling resistance would take it along.
TEST(belt, gives_a_free_sphere_two_sevenths_of_its_speed)
{
  Ride ride(on_belt({kSpeed, 0, 0}));
  const Real slips = 2 * kSpeed / (7 * kMu * kG);
  const Real t = ride.until_it_grips(2 * slips);
  expect_answer(belt("20a", "free sphere: time until the belt slips at a hundredth of its speed"),
                0.99 * slips, t, 3 * kStep, "two steps, and the half step that friction is late");
  for (int i = 0; i < 20000; i++) ride.step();
  // v - 2/5 R omega is conserved: rounding of 5e4 steps.
  expect_answer(belt("20b", "free sphere: speed over the belt's"), Real(2) / 7,
                ride.scene.v(0).x / kSpeed, 1e-10, "v + 2/5 R omega is kept but for rounding");
  EXPECT_NEAR(ride.scene.omega(0).y * kRadius, -5 * kSpeed / 7, 1e-10 * kSpeed);
  EXPECT_NEAR(ride.scene.v(0).y, 0, 1e-12);
  EXPECT_NEAR(ride.scene.x(0).z, kLevel, 1e-12);
}

// A body that cannot turn, as a block, is carried to the belt's speed: after u/(mu g).
TEST(belt, carries_a_sphere_that_cannot_turn_to_its_own_speed)
{
  Ride ride(on_belt({kSpeed, 0, 0}));
  ride.turns = false;
  const Real takes = kSpeed / (kMu * kG);
  const Real t = ride.until_it_grips(2 * takes);
  expect_answer(belt("20c", "sphere that cannot turn: time to 0.99 of the belt's speed"),
                0.99 * takes, t, 3 * kStep, "two steps, and the half step that friction is late");
  expect_answer(belt("20d", "sphere that cannot turn: way until then"), 0.5 * kMu * kG * t * t,
                ride.scene.x(0).x + 1, 2 * kSpeed * kStep, "two steps of the way");
  for (int i = 0; i < 20000; i++) ride.step();
  expect_answer(belt("20e", "sphere that cannot turn: speed over the belt's"), 1,
                ride.scene.v(0).x / kSpeed, 1e-10, "slip decays as exp(-gamma t), 0.2 s at 5000/s");
}

TEST(belt, does_not_drag_what_moves_with_it)
{
  const Vec3 u = {1.5, -0.7, 0};
  Scene scene(floor_mesh(4, 2), kRadius, [&] {
    EngineSettings s = hooke_history(kStiffness, 3e4, 0, 40, kMu);
    s.surface.velocity = u;
    return s;
  }());
  scene.add_sphere({0.1, 0.2, kRadius - 0.01}, kRadius, kMass, u);
  for (int i = 0; i < 10; i++) scene.compute(kStep);
  EXPECT_EQ(scene.force(0).x, 0);
  EXPECT_EQ(scene.force(0).y, 0);
  EXPECT_EQ(scene.springs.spring(0, 0).shear, (Vec3{0, 0, 0}));
}

TEST(belt, stretches_the_spring_of_a_sphere_at_rest)
{
  EngineSettings s = hooke_history(kStiffness, 3e4, 0, 0, 1e6);
  s.surface.velocity = {1.5, -0.7, 0};
  Scene scene(floor_mesh(4, 2), kRadius, s);
  scene.add_sphere({0.1, 0.2, kRadius - 0.01}, kRadius, kMass);
  for (int i = 0; i < 100; i++) scene.compute(kStep);
  const Vec3 pull = (3e4 * 100 * kStep) * s.surface.velocity;
  EXPECT_LE(norm(scene.force(0) - Vec3{pull.x, pull.y, kStiffness * 0.01}), 1e-9);
}

// The wall stays where it is, so that only the velocity along the contact may act.
TEST(belt, does_not_push_along_the_normal)
{
  Vec3 force[2];
  for (int moving = 0; moving < 2; moving++) {
    EngineSettings s = hooke(kStiffness, 50, 100, kMu);
    s.surface.velocity = {0, 0, moving ? 3.0 : 1e-300};
    Scene scene(floor_mesh(4, 2), kRadius, s);
    scene.add_sphere({0.1, 0.2, kRadius - 0.01}, kRadius, kMass, {0.3, 0, -0.2}, {1, 2, 3});
    scene.compute(kStep);
    force[moving] = scene.force(0);
  }
  EXPECT_EQ(force[0], force[1]);

  // A box face along (1, 1, 0)/sqrt 2 would feel half of a velocity along x.
  EngineSettings s = on_belt({kSpeed, 0, 0});
  Scene scene(hinge_mesh(45, 4), kRadius, s);
  const Real r = std::sqrt(0.5);
  const Vec3 n = {-r, 0, r}, p = {1, 0.3, 1};
  scene.add_sphere(p + (kRadius - 0.01) * n, kRadius, kMass);
  scene.compute(kStep);
  EXPECT_NEAR(dot(scene.force(0), n), kStiffness * 0.01, 1e-9);
  // Up the slope, since that is where its projection goes, and no more than friction can.
  EXPECT_NEAR(dot(scene.force(0), Vec3{r, 0, r}), kMu * kStiffness * 0.01, 1e-9);
}

// A turntable drags along its circles; a roll drags along its round and does not push.
TEST(roll, drags_along_its_circles)
{
  EngineSettings s = hooke(kStiffness, 0, 3, 1e6);
  s.surface.angular = {0, 0, 4};
  s.surface.centre = {0.5, -0.25, 7};
  Scene scene(floor_mesh(6, 2), kRadius, s);
  scene.add_sphere({1.3, 0.2, kRadius - 0.01}, kRadius, kMass);
  scene.compute(kStep, false);
  const Vec3 drag = (kMass * 3) * Vec3{-4 * 0.45, 4 * 0.8, 0};
  EXPECT_LE(norm(scene.force(0) - drag - Vec3{0, 0, kStiffness * 0.01}), 1e-9);

  s.surface.angular = {0, 0, 4};
  s.surface.centre = {0, 0, 0};
  Scene drum(cylinder_mesh(12, 1, 2, 4), kRadius, s);
  // Beside the middle of a facet, where the roll's surface also moves into the facet.
  const Real a = kPi / 12 + 0.1, apothem = 2 * std::cos(kPi / 12);
  const Vec3 n = {std::cos(kPi / 12), std::sin(kPi / 12), 0}, t = {-n.y, n.x, 0};
  const Vec3 closest = apothem * n + (apothem * std::tan(a - kPi / 12)) * t + Vec3{0, 0, 2.2};
  drum.add_sphere(closest + (kRadius - 0.01) * n, kRadius, kMass);
  drum.compute(kStep, false);
  EXPECT_NEAR(dot(drum.force(0), n), kStiffness * 0.01, 1e-9);
  EXPECT_NEAR(dot(drum.force(0), t), kMass * 3 * 4 * apothem, 1e-9);
  EXPECT_NEAR(drum.force(0).z, 0, 1e-9);
}

}    // namespace
}    // namespace lsdcd::test_belt
