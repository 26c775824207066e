// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Friction, rolling resistance and cohesion as LIGGGHTS has them, against closed forms.
#include "law/submodels/cohesion.h"
#include "law/submodels/rolling.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

// Returns the factor of the angle by which the springs of LIGGGHTS roll at a wall: (R - overlap/2)/(R - overlap).
Real lever(Real overlap)
{
  return (kRadius - overlap / 2) / (kRadius - overlap);
}

struct ElasticPlastic {
  RollingModel model;
  std::vector<Real> numbers;    // beside mu
  Real stiffness, damping;      // torque/angle
};

// epsd2 has k_t R^2, epsd 2.25 k_n mu^2 R^2, and epsd3 a number for the 2.25.
std::vector<ElasticPlastic> elastic_plastic_models(Real k_normal, Real k_tangent)
{
  const Real sq = kRadius * kRadius, of_normal = k_normal * kMuRoll * kMuRoll * sq;
  return {{RollingModel::epsd2, {}, k_tangent * sq, 0},
          {RollingModel::epsd, {0.3}, 2.25 * of_normal, 0.3},
          {RollingModel::epsd, {0}, 2.25 * of_normal, 0},
          {RollingModel::epsd3, {0.1, 5}, 5 * of_normal, 0.1}};
}

EngineSettings with_rolling(EngineSettings s, const ElasticPlastic &rolling)
{
  s = with_rolling(s, rolling.model);
  std::copy(rolling.numbers.begin(), rolling.numbers.end(), s.law().rolling.numbers + 1);
  return s;
}

// Below its limit it has a dashpot of 2 damping sqrt(I k), I = 7/5 m R^2, too.
TEST(elastic_plastic_rolling, holds_a_couple_that_grows_with_the_angle_up_to_its_limit)
{
  const Real overlap = 0.01, dt = 1e-4, limit = kMuRoll * kStiffness * overlap * kRadius;
  const Real rate = lever(overlap) * std::hypot(0.3, -0.2);
  for (const ElasticPlastic &rolling : elastic_plastic_models(kStiffness, kTangent)) {
    EngineSettings s = with_rolling(hooke(kStiffness), rolling);
    s.law().k_tangent = kTangent;
    Scene scene(floor_mesh(4, 2), kRadius, s);
    const Vec3 omega = {0.3, -0.2, 5};    // what twists does not roll
    scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, omega);
    // It yields within half of the steps.
    const int steps = static_cast<int>(2 * limit / (rolling.stiffness * rate * dt));
    const Real dashpot =
        2 * rolling.damping * std::sqrt(1.4 * kMass * kRadius * kRadius * rolling.stiffness) * rate;
    for (int i = 1; i <= steps; i++) {
      scene.compute(dt);
      const Real held = rolling.stiffness * rate * i * dt;
      const Real couple = held > limit ? limit : held + dashpot;
      const Vec3 expected = (-couple / std::hypot(0.3, -0.2)) * Vec3{0.3, -0.2, 0};
      ASSERT_LE(norm(scene.torque(0) - expected), 1e-9 * (limit + dashpot)) << i;
      ASSERT_EQ(scene.force(0).x, 0);
    }
    // A step of setup moves nothing.
    const Vec3 held = scene.torque(0);
    scene.compute(dt, false);
    EXPECT_LE(norm(scene.torque(0) - held), 1e-14 * norm(held));
  }
}

// What is held is the square of the torque over twice its stiffness; a dashpot holds nothing.
TEST(elastic_plastic_rolling, holds_the_energy_of_its_spring)
{
  const Real overlap = 0.01, dt = 1e-4, of_normal = kStiffness * overlap * overlap / 2;
  for (const ElasticPlastic &rolling : elastic_plastic_models(kStiffness, kTangent)) {
    EngineSettings s = with_rolling(hooke(kStiffness), rolling);
    s.law().k_tangent = kTangent;
    Scene scene(floor_mesh(4, 2), kRadius, s);
    scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, {0.3, -0.2, 5});
    for (int i = 0; i < 3; i++) scene.compute(dt);
    const Real angle = 3 * dt * lever(overlap) * std::hypot(0.3, -0.2);
    const Real held = rolling.stiffness * angle * angle / 2;
    EXPECT_NEAR(scene.engine->results().totals().energy - of_normal, held,
                1e-9 * held + 4e-15 * of_normal);
  }
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
      kTangent * std::sqrt(kRadius * overlap) * kRadius * kRadius * lever(overlap) * 0.01 * dt;
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

// A normal sub-model of `granular`, an overlap, and there k_n and the force that friction is proportional to.
struct Pressed {
  EngineSettings settings;
  Real overlap, k_normal, limit;
};

std::vector<Pressed> pressed()
{
  const Real overlap = 0.01, a = std::sqrt(kRadius * overlap), gamma = 3;
  const Real hertz = kStiffness * a, force = hertz * overlap;
  // jkr by its contact radius.
  const Real e = 0.75 * kStiffness, of_jkr = 0.08;
  const Real sunk = of_jkr * of_jkr / kRadius - 2 * std::sqrt(kPi * gamma * of_jkr / e);
  const Real pulled = 4 * e * std::pow(of_jkr, 3) / (3 * kRadius) -
                      4 * std::sqrt(kPi * gamma * e * std::pow(of_jkr, 3));
  return {{granular(NormalModel::hooke, kStiffness), overlap, kStiffness, kStiffness * overlap},
          {granular(NormalModel::hertz, kStiffness), overlap, hertz, force},
          {granular(NormalModel::dmt, kStiffness, gamma), overlap, hertz,
           force + 4 * kPi * gamma * kRadius},
          {granular(NormalModel::jkr, kStiffness, gamma), sunk, Real(4) / 3 * e * of_jkr,
           pulled + 6 * kPi * gamma * kRadius}};
}

// The torque of two steps at this spin.
Vec3 torque_after(int steps, const EngineSettings &s, Real overlap, const Vec3 &omega, Real dt)
{
  Scene scene(floor_mesh(4, 2), cutoff_of(s.law(), kRadius), s);
  scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, omega);
  for (int i = 0; i < steps; i++) scene.compute(dt);
  return scene.torque(0);
}

TEST(cdt, goes_with_each_normal_sub_model)
{
  for (const Pressed &p : pressed()) {
    const Vec3 couple =
        torque_after(1, with_rolling(p.settings, RollingModel::cdt), p.overlap, {3, -4, 12}, 1e-4);
    const Real size = kMuRoll * p.k_normal * p.overlap * kRadius / 13;
    EXPECT_LE(norm(couple + size * Vec3{3, -4, 0}), 1e-9 * norm(couple));
  }
}

TEST(elastic_plastic_rolling, goes_with_each_normal_sub_model)
{
  const Real spin = 0.5, dt = 1e-6;
  for (const Pressed &p : pressed())
    for (const ElasticPlastic &rolling : elastic_plastic_models(p.k_normal, kTangent)) {
      EngineSettings s = with_rolling(p.settings, rolling);
      s.law().tangential = TangentialModel::linear_history;
      s.law().k_tangent = kTangent;
      const Real rate = lever(p.overlap) * spin;
      const Real dashpot = 2 * rolling.damping *
                           std::sqrt(1.4 * kMass * kRadius * kRadius * rolling.stiffness) * rate;
      const Real couple = rolling.stiffness * rate * 2 * dt + dashpot;
      EXPECT_NEAR(torque_after(2, s, p.overlap, {spin, 0, 0}, dt).x, -couple, 1e-8 * couple);
      const Real limit = kMuRoll * p.limit * kRadius;
      EXPECT_NEAR(torque_after(2, s, p.overlap, {1e3 * spin, 0, 0}, 1).x, -limit, 1e-8 * limit);
    }
}

// ---- friction ------------------------------------------------------------------------------

// The slip is that of the middle of the overlap, where the force acts. The spring alone is cut by the limit, and the dashpot
// acts while it is not.
TEST(liggghts_friction, has_its_dashpot_while_it_sticks)
{
  const Real overlap = 0.05, dt = 1e-4, mu = 0.3, ratio = 0.7, damping = 40, spin = 0.2,
             arm = kRadius - overlap / 2, slip = 0.1 - arm * spin;
  const Real a = std::sqrt(kRadius * overlap), limit = mu * kStiffness * a * overlap;
  for (const TangentialModel model :
       {TangentialModel::linear_nohistory_liggghts, TangentialModel::linear_history_liggghts,
        TangentialModel::mindlin_liggghts}) {
    EngineSettings s = granular(NormalModel::hertz, kStiffness);
    s.law().tangential = model;
    s.law().k_tangent = model == TangentialModel::linear_history_liggghts ? kTangent : kTangent / a;
    s.law().xgammat = ratio;
    s.law().mu = mu;
    s.law().damping = DampingModel::velocity;
    s.law().eta = damping;
    Scene scene(floor_mesh(4, 2), kRadius, s);
    // It goes along x, and its spin about y takes the contact back.
    scene.add_sphere({0.1, 0.2, kRadius - overlap}, kRadius, kMass, {0.1, 0, 0}, {0, spin, 0});
    const bool spring = model != TangentialModel::linear_nohistory_liggghts;
    const int steps = static_cast<int>(1.5 * limit / (kTangent * slip * dt));
    for (int i = 1; i <= steps; i++) {
      scene.compute(dt);
      const Real stretched = spring ? kTangent * slip * i * dt : 0;
      const Real force = stretched > limit ? limit : stretched + ratio * damping * slip;
      ASSERT_NEAR(scene.force(0).x, -force, 1e-9 * limit) << i;
      ASSERT_NEAR(scene.torque(0).y, force * arm, 1e-9 * limit) << i;
    }
    // A step of setup moves nothing, at the limit either.
    const Real held = scene.force(0).x;
    scene.compute(dt, false);
    EXPECT_NEAR(scene.force(0).x, held, 1e-14 * limit);
  }
}

// ---- cohesion ------------------------------------------------------------------------------

TEST(sjkr, goes_with_each_normal_sub_model)
{
  const Real k = 4e4;
  for (const Pressed &p : pressed()) {
    const auto force = [&](Real cohesion) {
      EngineSettings s = p.settings;
      if (cohesion > 0) s = with_cohesion(s, cohesion);
      Scene scene(floor_mesh(4, 2), cutoff_of(s.law(), kRadius), s);
      scene.add_sphere({0.1, 0.2, kRadius - p.overlap}, kRadius, kMass);
      scene.compute(1e-4);
      return scene.force(0).z;
    };
    const Real r = kRadius - p.overlap, pull = k * kPi * (kRadius * kRadius - r * r);
    EXPECT_NEAR(force(0) - force(k), pull, 1e-9 * pull);
  }
}

PairContact two_spheres(Real radius_i, Real radius_j, Real overlap)
{
  PairContact c = {};
  c.normal = {0, 0, 1};
  c.overlap = overlap;
  c.radius_i = radius_i;
  c.radius_j = radius_j;
  c.radius = radius_i * radius_j / (radius_i + radius_j);
  return c;
}

// Two spheres cut each other in a circle of radius h, at x from the centre of the first.
TEST(sjkr, of_two_spheres_pulls_with_k_times_the_area_of_their_cut)
{
  const SjkrCohesion cohesion = {4e4};
  for (const Real rj : {0.5, 0.05, 7.0})
    for (const Real overlap : {1e-5, 1e-3, 0.02}) {
      const Real ri = 0.5, r = ri + rj - overlap, x = (r * r + ri * ri - rj * rj) / (2 * r);
      const Real area = kPi * (ri - x) * (ri + x);
      // ri - x is a difference of numbers of 7 whose last digit is 1e-15.
      EXPECT_NEAR(cohesion.pull(two_spheres(ri, rj, overlap)), 4e4 * area, 4e4 * 1e-13) << rj;
      EXPECT_EQ(cohesion.pull(two_spheres(ri, rj, overlap)),
                cohesion.pull(two_spheres(rj, ri, overlap)));
    }
  // A wall is a sphere without end.
  Contact wall = {};
  wall.overlap = 0.02;
  wall.radius = 0.5;
  EXPECT_NEAR(cohesion.pull(two_spheres(0.5, 1e8, 0.02)), cohesion.pull(wall), 1e-7 * 4e4);
  EXPECT_NEAR(cohesion.energy(two_spheres(0.5, 1e8, 0.02)), cohesion.energy(wall), 1e-7 * 4e4);
}

TEST(sjkr, of_two_spheres_has_the_energy_of_its_work)
{
  const SjkrCohesion cohesion = {4e4};
  const Real ri = 0.5, rj = 0.2, overlap = 0.05;
  Real work = 0;    // by the midpoints of 1e4 steps, whose error is 1e-8 of it
  const int n = 10000;
  for (int i = 0; i < n; i++)
    work -= cohesion.pull(two_spheres(ri, rj, (i + 0.5) * overlap / n)) * overlap / n;
  EXPECT_NEAR(cohesion.energy(two_spheres(ri, rj, overlap)), work, 1e-7 * -work);
}

// Of two spheres the inertia is the reduced one of m R^2, and the spin is not that of a wall.
TEST(epsd, of_two_spheres_has_their_reduced_inertia)
{
  PairContact c = two_spheres(0.5, 0.2, 0.01);
  c.mass_i = 2;
  c.mass_j = 0.3;
  c.omega = {0.1, 0, 3};
  c.dt = 1e-3;
  c.update = true;
  const Real k = 2.25 * kStiffness * kMuRoll * kMuRoll * c.radius * c.radius;
  const Real i = 2 * 0.5 * 0.5, j = 0.3 * 0.2 * 0.2, inertia = 1.4 / (1 / i + 1 / j);
  const Real numbers[] = {kMuRoll, 0.3, 0};
  ContactMemory<3> memory = {};
  const RollingInput<PairContact> in = {c, 1e9, kStiffness, kTangent};
  const Real couple = k * 0.1 * 1e-3 + 2 * 0.3 * std::sqrt(inertia * k) * 0.1;
  EXPECT_NEAR(EpsdRolling::contact_torque(numbers, in, memory, 0).x, -couple, 1e-12 * couple);
  EXPECT_NEAR(memory.vec(0).x, -k * 0.1 * 1e-3, 1e-12 * couple);
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
