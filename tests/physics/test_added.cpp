// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rolling friction and cohesion as LIGGGHTS has them, against closed forms.
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_added {
namespace {

constexpr Real kStiffness = 1e5, kTangent = 3e4, kRadius = 0.5, kMass = 2, kG = 10;
constexpr Real kMuRoll = 0.02;
const Real kLevel = kRadius - kMass * kG / kStiffness;

EngineSettings with_rolling(EngineSettings s, RollingModel rolling)
{
  s.law().rolling = {rolling, {kMuRoll}};
  return s;
}

EngineSettings with_cohesion(EngineSettings s, Real k)
{
  s.law().cohesion = {CohesionModel::sjkr, {k}};
  return s;
}

// Rolls over many seams from x = -1.5 at 0.3 until it no longer does; the way it makes.
Real way_until_it_stops(Scene &scene, Real dt)
{
  const Real v = 0.3;
  scene.add_sphere({-1.5, 0.13, kLevel}, kRadius, kMass, {v, 0, 0}, {0, v / kRadius, 0});
  scene.compute(dt, false);
  for (int i = 0; i < 400000 && scene.v(0).x > 1e-5; i++) scene.step(dt, {0, 0, -kG});
  EXPECT_LE(scene.v(0).x, 1e-5) << "still rolling";
  EXPECT_NEAR(scene.v(0).y, 0, 1e-12);
  return scene.x(0).x + 1.5;
}

// The contact torque mu m g R slows rolling by 5/7 mu g: it stops after 7 v^2/(10 mu g).
TEST(cdt, stops_a_rolling_sphere_at_the_analytic_distance)
{
  const Real exact = 0.7 * 0.3 * 0.3 / (kMuRoll * kG);
  Scene scene(floor_mesh(16, 2, 3), kRadius,
              with_rolling(hooke(kStiffness, 50, 5000, 0.3), RollingModel::cdt));
  // Viscous friction creeps by 5/7 mu g/(5000/s) = 3e-5, 1e-4 of the speed.
  EXPECT_NEAR(way_until_it_stops(scene, 1e-5), exact, 1e-4 * exact);
}

// m dv = F, I dw = -R F +- M: with the belt's speed u the slip ends at
// t1 = u/(mu g + 5/2 (mu - mu_r) g), and rolling friction then takes the sphere along by
// 5/7 mu_r g until it stands on the belt.
TEST(cdt, lets_a_belt_carry_a_sphere_to_its_speed_CPU)
{
  const Real u = 0.5, mu = 0.3, dt = 1e-5;
  EngineSettings s = with_rolling(hooke(kStiffness, 50, 5000, mu), RollingModel::cdt);
  s.surface.velocity = {u, 0, 0};
  Scene scene(floor_mesh(16, 2, 3), kRadius, s);
  scene.add_sphere({-1.5, 0.13, kLevel}, kRadius, kMass);
  scene.compute(dt, false);
  const Real t1 = u / (mu * kG + 2.5 * (mu - kMuRoll) * kG);
  const Real t2 = (u - mu * kG * t1) / (Real(5) / 7 * kMuRoll * kG);
  Real t = 0;
  while (scene.v(0).x < 0.999 * u && t < 2 * (t1 + t2)) {
    scene.step(dt, {0, 0, -kG});
    t += dt;
  }
  const Real exact = t1 + t2 - 0.001 * u / (Real(5) / 7 * kMuRoll * kG);
  EXPECT_NEAR(t, exact, 1e-3 * exact);
  for (int i = 0; i < 20000; i++) scene.step(dt, {0, 0, -kG});
  // It turns no more but for a step's change of the spin.
  EXPECT_NEAR(scene.v(0).x, u, 1e-4 * u);
  EXPECT_LE(norm(scene.omega(0)), 2 * dt * kMuRoll * kG / (0.4 * kRadius));
}

// The spring takes up to M = mu m g R, over the way x_y = mu m g/k_t; the energy
// 7/10 m v^2 is M/R (x - x_y/2).
TEST(epsd2, stops_a_rolling_sphere_at_the_analytic_distance_CPU)
{
  for (const Real k : {300.0, 3e4}) {
    const Real yields = kMuRoll * kMass * kG / k;
    const Real exact = 0.7 * 0.3 * 0.3 / (kMuRoll * kG) + yields / 2;
    EngineSettings s = with_rolling(hooke(kStiffness, 50, 5000, 0.3), RollingModel::epsd2);
    s.law().k_tangent = k;
    Scene scene(floor_mesh(16, 2, 3), kRadius, s);
    EXPECT_NEAR(way_until_it_stops(scene, 1e-5), exact, 1e-4 * exact) << k;
  }
}

TEST(epsd2, holds_a_couple_that_grows_with_the_angle_up_to_its_limit)
{
  const Real overlap = 0.01, dt = 1e-4, limit = kMuRoll * kStiffness * overlap * kRadius;
  EngineSettings s = with_rolling(hooke(kStiffness), RollingModel::epsd2);
  s.law().k_tangent = kTangent;
  Scene scene(floor_mesh(4, 2), kRadius, s);
  const Vec3 omega = {0.3, -0.2, 5};    // what twists does not roll
  scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, omega);
  for (int i = 1; i <= 400; i++) {
    scene.compute(dt);
    const Real turned = std::hypot(0.3, -0.2) * i * dt;
    const Real contact_torque = std::min(kTangent * kRadius * kRadius * turned, limit);
    const Vec3 expected = (-contact_torque / std::hypot(0.3, -0.2)) * Vec3{0.3, -0.2, 0};
    ASSERT_LE(norm(scene.torque(0) - expected), 1e-9 * limit) << i;
    ASSERT_EQ(scene.force(0).x, 0);
  }
  // A step of setup moves nothing.
  const Vec3 held = scene.torque(0);
  scene.compute(dt, false);
  EXPECT_LE(norm(scene.torque(0) - held), 1e-14 * norm(held));
}

// With hertz both limit and stiffness go with the contact: k_t sqrt(R overlap) R^2.
TEST(epsd2, grows_with_the_contact_radius_of_hertz)
{
  const Real overlap = 0.01, dt = 1e-4;
  Scene scene(floor_mesh(4, 2), kRadius,
              with_rolling(hertz_history(kStiffness, kTangent, 0, 0, 0), RollingModel::epsd2));
  scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, {0.01, 0, 0});
  scene.compute(dt);
  const Real contact_torque =
      kTangent * std::sqrt(kRadius * overlap) * kRadius * kRadius * 0.01 * dt;
  EXPECT_NEAR(scene.torque(0).x, -contact_torque, 1e-10 * contact_torque);
}

// Against the whole spin, as LIGGGHTS has it, of which the part across the normal is a torque of rolling: a spin about the
// normal makes it less.
TEST(cdt, is_mu_times_the_elastic_force_times_the_radius)
{
  const Real overlap = 0.01;
  for (const bool hertz : {false, true}) {
    EngineSettings s =
        hertz ? hertz_history(kStiffness, kTangent, 30, 0, 0) : hooke(kStiffness, 30);
    Scene scene(floor_mesh(4, 2), kRadius, with_rolling(s, RollingModel::cdt));
    // It sinks in, so that damping adds to the force, which cdt does not see.
    scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, -1}, {3, -4, 12});
    scene.compute(1e-4);
    const Real elastic = kStiffness * overlap * (hertz ? std::sqrt(kRadius * overlap) : 1);
    const Vec3 contact_torque = (-kMuRoll * elastic * kRadius / 13) * Vec3{3, -4, 0};
    EXPECT_LE(norm(scene.torque(0) - contact_torque), 1e-10 * norm(contact_torque));
  }
}

TEST(sjkr, pulls_with_k_times_the_area_of_the_cut)
{
  const Real k = 4e4;
  for (const Real overlap : {1e-4, 0.01, 0.2}) {
    const Real r = kRadius - overlap, area = kPi * (kRadius * kRadius - r * r);
    for (const bool hertz : {false, true}) {
      const EngineSettings s =
          hertz ? hertz_history(kStiffness, kTangent, 0, 0, 0.3) : hooke(kStiffness, 0, 0, 0.3);
      Scene scene(floor_mesh(4, 2), kRadius, with_cohesion(s, k));
      scene.add_sphere({0.1, 0.2, r}, kRadius, kMass);
      scene.compute(1e-4);
      const Real elastic = kStiffness * overlap * (hertz ? std::sqrt(kRadius * overlap) : 1);
      EXPECT_NEAR(scene.force(0).z, elastic - k * area, 1e-9 * (elastic + k * area));
    }
  }
}

TEST(sjkr, does_not_change_the_friction)
{
  Vec3 force[2];
  for (int coheres = 0; coheres < 2; coheres++) {
    Scene scene(floor_mesh(4, 2), kRadius,
                with_cohesion(hooke(kStiffness, 0, 1e4, 0.3), coheres ? 4e4 : 1e-300));
    scene.add_sphere({0.1, 0.2, kRadius - 0.01}, kRadius, kMass, {1, 0, 0});
    scene.compute(1e-4);
    force[coheres] = scene.force(0);
  }
  EXPECT_EQ(force[0].x, force[1].x);
  EXPECT_NEAR(force[0].x, -0.3 * kStiffness * 0.01, 1e-9);
}

// Without damping a bounce gives back all: what cohesion holds is in the energy.
TEST(sjkr, energy_is_the_work_of_its_force)
{
  Scene scene(floor_mesh(4, 2), kRadius, with_cohesion(hooke(kStiffness), 4e4));
  scene.add_sphere({0.1, 0.2, 0}, kRadius, kMass);
  const auto at = [&](Real overlap) {
    scene.set_x(0, {0.1, 0.2, kRadius - overlap});
    scene.compute(1e-4);
    return scene.engine->results().totals().energy;
  };
  const Real h = 1e-5;
  for (const Real overlap : {0.001, 0.05, 0.3}) {
    const Real slope = (at(overlap + h) - at(overlap - h)) / (2 * h);
    at(overlap);
    // The energy is a cubic: its third derivative times h^2/6.
    EXPECT_NEAR(scene.force(0).z, slope, kPi * 4e4 * h * h + 1e-6) << overlap;
  }
}

TEST(rolling_and_cohesion, act_together_as_each_alone)
{
  const Real overlap = 0.01;
  EngineSettings s = with_rolling(hooke(kStiffness, 0, 0, 0), RollingModel::cdt);
  Scene both(floor_mesh(4, 2), kRadius, with_cohesion(s, 4e4));
  both.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, {3, -4, 0});
  both.compute(1e-4);
  EXPECT_NEAR(norm(both.torque(0)), kMuRoll * kStiffness * overlap * kRadius, 1e-10);
  EXPECT_LT(both.force(0).z, kStiffness * overlap);
}

}    // namespace
}    // namespace lsdcd::test_added
