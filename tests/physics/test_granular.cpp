// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The sub-models of `granular` against closed forms.
#include "backend/backend_cpu.h"
#include "engine/step/compile_law.h"
#include "law/sub_models.h"
#include "law/submodels/normal.h"
#include "support/crowd.h"
#include "support/kept_springs.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

namespace lsdcd::test_granular {
namespace {

constexpr Real kRadius = 0.5, kMass = 2, kK = 1e5, kModulus = 0.75 * kK;

const Vec3 kSpot = {0.13, 0.07, 0};    // inside a face

// One sphere over a floor; a test moves it by hand.
struct OneSphere {
  Scene scene;
  Real height = 0;
  explicit OneSphere(const EngineSettings &law, int n = 4, unsigned seed = 0) :
      scene(floor_mesh(n, 2, seed), cutoff_of(law.law(), kRadius), law)
  {
    scene.add_sphere(kSpot + Vec3{0, 0, 2 * kRadius}, kRadius, kMass);
  }
  Vec3 at(Real overlap, Real dt = 1e-6)
  {
    Vec3 x = scene.x(0);
    x.z = kRadius - overlap;
    scene.set_x(0, x);
    scene.compute(dt);
    return scene.force(0);
  }
};

// ---- adhesion --------------------------------------------------------------------------------

TEST(dmt, pulls_with_four_pi_gamma_r_when_it_barely_touches)
{
  const Real gamma = 3;
  OneSphere s(granular(NormalModel::dmt, kK, gamma));
  EXPECT_EQ(s.at(-1e-12).z, 0);
  // The Hertz force at an overlap of 1e-12 is 1e5 0.7e-6 1e-12.
  EXPECT_NEAR(s.at(1e-12).z, -4 * kPi * gamma * kRadius, 1e-12);
  const Real overlap = 0.01;
  EXPECT_NEAR(s.at(overlap).z,
              kK * std::sqrt(kRadius * overlap) * overlap - 4 * kPi * gamma * kRadius, 1e-11);
}

struct Jkr {
  Real gamma = 3, modulus = kModulus;
  Real pull_off() const    // distance past touch where it lets go
  {
    return std::cbrt(3 * kPi * kPi * gamma * gamma * kRadius / (16 * modulus * modulus));
  }
  EngineSettings law() const { return granular(NormalModel::jkr, modulus * 4 / 3, gamma); }
};

TEST(jkr, lets_go_at_three_pi_gamma_r)
{
  const Jkr jkr;
  OneSphere s(jkr.law());
  s.at(1e-3);
  Real least = 0;
  for (Real gap = 0; gap < jkr.pull_off() * (1 - 1e-9); gap += jkr.pull_off() / 5000)
    least = std::min(least, s.at(-gap).z);
  // The pull is flat at its largest: 1/5000 of the way off it is 1e-7 less.
  EXPECT_NEAR(least, -3 * kPi * jkr.gamma * kRadius, 1e-6);
  EXPECT_LT(s.at(-jkr.pull_off() * (1 - 1e-9)).z, 0);
  EXPECT_EQ(s.at(-jkr.pull_off() * (1 + 1e-9)).z, 0);
}

TEST(jkr, pulls_with_eight_thirds_pi_gamma_r_at_no_overlap)
{
  // a^3 = 4 pi gamma R^2 / E there.
  const Jkr jkr;
  OneSphere s(jkr.law());
  s.at(1e-3);
  EXPECT_NEAR(s.at(0).z, -8.0 / 3 * kPi * jkr.gamma * kRadius, 1e-10);
}

TEST(jkr, holds_only_what_has_touched)
{
  const Jkr jkr;
  const Real gap = 0.5 * jkr.pull_off();
  OneSphere s(jkr.law());
  EXPECT_EQ(s.at(-gap).z, 0);
  EXPECT_LT(s.at(1e-6).z, 0);
  EXPECT_LT(s.at(-gap).z, 0);
  EXPECT_EQ(s.at(-1.01 * jkr.pull_off()).z, 0);
  EXPECT_EQ(s.at(-gap).z, 0);
}

// With the rule that adds forces each side of a hinge holds what has touched that side.
TEST(jkr, on_one_side_of_a_hinge_is_not_held_by_the_other)
{
  const Jkr jkr;
  EngineSettings law = jkr.law();
  law.corner = Corner::sum;
  const Real angle = kPi / 18, height = kRadius - 1e-6, gap = 0.5 * jkr.pull_off();
  Scene scene(hinge_mesh(10, 4), cutoff_of(law.law(), kRadius), law);
  // The other side is at a distance of cos(angle) z - sin(angle) x.
  scene.add_sphere({(std::cos(angle) * height - kRadius - gap) / std::sin(angle), 0.11, height},
                   kRadius, kMass);
  scene.compute(1e-6);
  const Vec3 first = scene.force(0);
  EXPECT_LT(first.z, 0);
  scene.compute(1e-6);
  EXPECT_EQ(scene.force(0), first);
}

TEST(jkr, loses_the_work_between_touch_and_pull_off_in_a_cycle)
{
  // By the contact radius a: overlap and force in closed form, the work between a at no
  // overlap and a where it lets go by Simpson's rule on 2000 intervals (error 1e-13).
  const Jkr jkr;
  const Real e = jkr.modulus, g = jkr.gamma, r = kRadius;
  const auto force = [&](Real a) {
    return 4 * e * a * a * a / (3 * r) - 4 * std::sqrt(kPi * g * e * a * a * a);
  };
  const auto rate = [&](Real a) { return 2 * a / r - std::sqrt(kPi * g / (e * a)); };
  const Real from = std::cbrt(9 * kPi * g * r * r / (4 * e)),
             to = std::cbrt(4 * kPi * g * r * r / e);
  const int n = 2000;
  Real work = 0;
  for (int i = 0; i <= n; i++) {
    const Real a = from + (to - from) * i / n;
    work += (i == 0 || i == n ? 1 : (i % 2 ? 4 : 2)) * force(a) * rate(a);
  }
  work *= (to - from) / (3 * n);

  OneSphere s(jkr.law());
  s.at(1e-5);
  // The energy of the engine at both ends, and again by summing its force.
  s.at(0);
  const Real at_touch = s.scene.engine->results().totals().energy;
  const int steps = 20000;
  Real sum = 0;
  for (int i = 0; i < steps; i++)
    sum += s.at(-jkr.pull_off() * (i + 0.5) / steps).z * jkr.pull_off() / steps;
  s.at(-jkr.pull_off() * (1 - 1e-12));
  const Real at_pull_off = s.scene.engine->results().totals().energy;
  EXPECT_NEAR(sum, work, 1e-7 * std::fabs(work));
  EXPECT_NEAR(at_touch - at_pull_off, work, 1e-9 * std::fabs(work));
}

TEST(jkr, contact_radius_solves_its_equation_from_no_to_strong_adhesion)
{
  for (Real gamma : {0.0, 1e-12, 1e-6, 1e-3, 1.0, 1e3})
    for (Real overlap : {1e-9, 1e-6, 1e-4, 1e-2, 0.0, -0.3, -0.7, -0.999}) {
      const JkrNormal law(kModulus, gamma);
      Contact c = {};
      c.radius = kRadius;
      c.overlap = overlap < 0 ? overlap * law.pull_off * std::cbrt(kRadius) : overlap;
      const long double a = law.contact_radius(c);
      if (gamma == 0 && overlap <= 0) {
        EXPECT_EQ(a, 0);
        continue;
      }
      const long double left = a * a / kRadius, right = 2 * std::sqrt(kPi * gamma * a / kModulus);
      // a to a few roundings: the two sides to their own size times that.
      EXPECT_NEAR(double(left - right), c.overlap, double(4e-15 * (left + right)))
          << gamma << ' ' << overlap;
    }
}

TEST(jkr, sphere_slides_under_a_ceiling_of_triangles_without_falling_CPU)
{
  // It hangs by its adhesion past touch, over faces, edges and vertices alike: the weight
  // is 0.9 of the pull-off force. Its springs go along.
  const Jkr jkr;
  const Real weight = 0.9 * 3 * kPi * jkr.gamma * kRadius;
  for (const Corner corner : {Corner::blend, Corner::sum}) {
    EngineSettings law = jkr.law();
    law.corner = corner;
    law.law().damping = DampingModel::mass_velocity;
    law.law().eta = 50;
    Scene scene(floor_mesh(16, 2, 5), cutoff_of(law.law(), kRadius), law);
    const Real touch = -kRadius + 1e-6;
    scene.add_sphere({-1, 0.11, touch}, kRadius, kMass, {0, 0, 0});
    const Real dt = 2e-4;
    // Let down gently, then pushed along.
    for (int i = 0; i < 20000; i++)
      scene.step(dt, {0, 0, -weight / kMass * std::min(1.0, i / 15000.0)});
    scene.set_v(0, {0.5, 0.1, 0});
    for (int i = 0; i < 20000; i++) scene.step(dt, {0, 0, -weight / kMass});
    EXPECT_NEAR(scene.x(0).x, 1, 1e-9);    // nothing brakes it
    EXPECT_LT(scene.x(0).z, touch);
    EXPECT_GT(scene.x(0).z, touch - jkr.pull_off());
    EXPECT_NEAR(scene.force(0).z, weight, 1e-6);
  }
}

TEST(jkr, on_the_faces_of_a_drum_pulls_as_one_wall)
{
  // Past touch the sphere holds to several facets at once, which share its pull. In a
  // drum of many facets it is that of one smooth wall, to the sag of a facet.
  const Jkr jkr;
  EngineSettings law = jkr.law();
  const Real drum = 5;
  const int n = 512;
  Scene scene(cylinder_mesh(n, 1, drum, 4), cutoff_of(law.law(), kRadius), law);
  scene.add_sphere({drum - kRadius, 0, 2}, kRadius, kMass);
  scene.compute(1e-6);
  const Real gap = 0.5 * jkr.pull_off(), sag = drum * (1 - std::cos(kPi / n));
  OneSphere flat(law);
  flat.at(1e-6);
  for (int i = 1; i < 200; i++) {
    const Real angle = 2 * kPi / n * 3 * i / 200, out = drum - kRadius - gap - sag;
    scene.set_x(0, {out * std::cos(angle), out * std::sin(angle), 2});
    scene.compute(1e-6);
    const Real pull = norm(scene.force(0));
    // A facet is further off at its ends, and the pull grows with the gap.
    EXPECT_GE(pull, 0.9999 * std::fabs(flat.at(-gap).z)) << angle;
    EXPECT_LE(pull, 1.0001 * std::fabs(flat.at(-gap - sag).z)) << angle;
  }
}

// ---- restitution -------------------------------------------------------------------------------

Real restitution(const EngineSettings &law, Real speed, int steps_per_contact)
{
  Scene scene(floor_mesh(4, 2), kRadius, law);
  scene.add_sphere(kSpot + Vec3{0, 0, kRadius + 1e-12}, kRadius, kMass, {0, 0, -speed});
  // The time of a linear spring; a Hertz contact of this speed lasts about 2.5 times as long.
  const Real dt = kPi * std::sqrt(kMass / kK) / steps_per_contact;
  for (int i = 0; i < 40 * steps_per_contact; i++) {
    scene.step(dt, {0, 0, 0});
    if (scene.v(0).z > 0 && scene.engine->results().totals().contacts == 0) break;
  }
  return scene.v(0).z / speed;
}

TEST(damping, coeff_restitution_returns_what_is_set_CPU)
{
  for (const SubModel *row : sub_models(Family::normal))
    for (Real e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const auto normal = static_cast<NormalModel>(row->model);
      EngineSettings law = granular(normal, kK);
      // Some have no such damping, or lose energy by yielding, too (test_yielding).
      if (facts_of(normal).no_rebound == 0 || facts_of(normal).yields) continue;
      law.law().damping = DampingModel::stiffness;
      law.law().eta = restitution_damping(normal, e);
      EXPECT_NEAR(restitution(law, 0.5, 2000), e, 1e-3) << e;
    }
}

TEST(damping, tsuji_returns_what_is_set_CPU)
{
  // The fit itself is off by 1.1e-3 at most (at 0.8).
  for (Real e : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    EngineSettings law = granular(NormalModel::hertz, kK);
    law.law().damping = DampingModel::stiffness;
    law.law().eta = tsuji_damping(e);
    EXPECT_NEAR(restitution(law, 0.5, 2000), e, 1.2e-3) << e;
  }
}

TEST(damping, coefficients_are_those_of_their_names)
{
  // F_n less the elastic force, at a speed away from the wall.
  const Real overlap = 0.01, speed = 0.3, eta = 7, a = std::sqrt(kRadius * overlap);
  const auto drag = [&](DampingModel model) {
    EngineSettings law = granular(NormalModel::hertz, kK);
    law.law().damping = model;
    law.law().eta = eta;
    OneSphere s(law);
    const Real still = s.at(overlap).z;
    s.scene.set_v(0, {0, 0, speed});
    return (still - s.at(overlap).z) / speed;
  };
  EXPECT_EQ(drag(DampingModel::none), 0);
  EXPECT_NEAR(drag(DampingModel::velocity), eta, 1e-11);
  EXPECT_NEAR(drag(DampingModel::mass_velocity), eta * kMass, 1e-11);
  EXPECT_NEAR(drag(DampingModel::viscoelastic), eta * kMass * a, 1e-11);
  EXPECT_NEAR(drag(DampingModel::stiffness), eta * std::sqrt(kMass * kK * a), 1e-9);
}

// ---- tangential --------------------------------------------------------------------------------

EngineSettings with_tangential(TangentialModel model, Real k, Real mu)
{
  EngineSettings law = granular(NormalModel::hertz, kK);
  law.law().tangential = model;
  law.law().k_tangent = k;
  law.law().mu = mu;
  return law;
}

// Slides by `slip` at a first overlap, then stays still at a second: the force along x.
Real friction_after(TangentialModel model, Real slip, Real first, Real second)
{
  constexpr Real kT = 3e4;
  OneSphere s(with_tangential(model, kT, 100));
  s.scene.set_v(0, {1, 0, 0});
  s.at(first, slip);
  s.scene.set_v(0, {0, 0, 0});
  return s.at(second, slip).x / kT;
}

TEST(tangential, springs_stretch_and_shrink_with_the_contact_as_their_names_say)
{
  using M = TangentialModel;
  const Real slip = 1e-4, big = 0.01, small = 0.0036;
  const Real a = std::sqrt(kRadius * big), b = std::sqrt(kRadius * small), tol = 1e-18;
  EXPECT_NEAR(friction_after(M::linear_history, slip, big, small), -slip, tol);
  EXPECT_NEAR(friction_after(M::mindlin, slip, big, small), -b * slip, tol);
  EXPECT_NEAR(friction_after(M::mindlin_force, slip, big, small), -a * slip, tol);
  EXPECT_NEAR(friction_after(M::mindlin_rescale, slip, big, small), -b * b / a * slip, tol);
  EXPECT_NEAR(friction_after(M::mindlin_rescale_force, slip, big, small), -b * slip, tol);
  // Loading changes no displacement and no force held.
  EXPECT_NEAR(friction_after(M::mindlin_rescale, slip, small, big), -a * slip, tol);
  EXPECT_NEAR(friction_after(M::mindlin_rescale_force, slip, small, big), -b * slip, tol);
  EXPECT_EQ(friction_after(M::linear_nohistory, slip, big, small), 0);
}

TEST(tangential, friction_is_limited_by_mu_times_the_normal_force)
{
  using M = TangentialModel;
  for (M model : {M::linear_history, M::linear_history_slip, M::mindlin, M::mindlin_force,
                  M::mindlin_slip, M::mindlin_rescale, M::mindlin_rescale_force}) {
    OneSphere s(with_tangential(model, 3e4, 0.4));
    s.scene.set_v(0, {0.6, 0.8, 0});
    for (int i = 0; i < 3; i++) {
      const Vec3 f = s.at(0.01, 0.1);
      EXPECT_NEAR(f.x, -0.6 * 0.4 * f.z, 1e-12);
      EXPECT_NEAR(f.y, -0.8 * 0.4 * f.z, 1e-12);
    }
  }
}

TEST(tangential, friction_of_what_adheres_counts_twice_the_pull_off)
{
  const Real gamma = 3, overlap = 1e-3;
  const Jkr jkr;
  const std::vector<std::pair<EngineSettings, Real>> laws = {
      {granular(NormalModel::dmt, kK, gamma), 4 * kPi * gamma * kRadius},
      {jkr.law(), 3 * kPi * jkr.gamma * kRadius}};
  for (const auto &[base, pull] : laws) {
    EngineSettings law = base;
    law.law().tangential = TangentialModel::linear_history;
    law.law().k_tangent = 1e5;
    law.law().mu = 0.5;
    OneSphere s(law);
    s.scene.set_v(0, {1, 0, 0});
    const Vec3 f = s.at(overlap, 0.1);
    EXPECT_NEAR(f.x, -0.5 * std::fabs(f.z + 2 * pull), 1e-11);
  }
}

// ---- sliding with a dashpot ----------------------------------------------------------------------

constexpr TangentialModel kSlips[] = {TangentialModel::linear_history_slip,
                                      TangentialModel::mindlin_slip};
constexpr Real kSpring = 3e4, kMu = 0.4, kDashpot = 400;

// kSpring, kMu, and a dashpot of kDashpot (mass/time) along the wall and across it.
EngineSettings sliding(TangentialModel model)
{
  EngineSettings law = with_tangential(model, kSpring, kMu);
  law.law().damping = DampingModel::velocity;
  law.law().eta = kDashpot;
  law.law().xgammat = 1;
  return law;
}

Real hertz_radius(Real overlap)
{
  return std::sqrt(kRadius * overlap);
}

Real stiffness_at(TangentialModel model, Real overlap)
{
  return model == TangentialModel::mindlin_slip ? kSpring * hertz_radius(overlap) : kSpring;
}

TEST(slip, gives_a_grain_on_a_fast_belt_mu_times_its_impulse)
{
  // It falls at 1 m/s and gains at most 2 mu, its surface 3.5 times that: 2.8 of the belt's 10 m/s. So it slips to
  // the end. Some 2000 steps, each rounded by 1e-16.
  for (TangentialModel model : kSlips) {
    EngineSettings law = sliding(model);
    law.law().eta = 0.1 * kDashpot;    // so that it bounces
    law.law().xgammat = 10;
    law.surface.velocity = {10, 0, 0};
    Scene scene(floor_mesh(4, 2), kRadius, law);
    scene.add_sphere(kSpot + Vec3{0, 0, kRadius + 1e-12}, kRadius, kMass, {0, 0, -1});
    Real impulse = 0;
    const Real dt = 1e-5;
    do {
      scene.step(dt, {0, 0, 0});
      impulse += dt * std::fabs(scene.force(0).z);
    } while (scene.engine->results().totals().contacts > 0);
    EXPECT_NEAR(kMass * scene.v(0).x, kMu * impulse, 1e-12 * impulse) << static_cast<int>(model);
  }
}

TEST(slip, stretches_the_spring_against_it_and_never_past_the_limit)
{
  // From so slow that the spring alone brakes, to so fast that the dashpot alone passes the limit. Overlaps, of 1.5e-4
  // and more, are rounded by 1e-16.
  for (TangentialModel model : kSlips)
    for (Real speed : {1e-3, 0.1, 10.0}) {
      OneSphere s(sliding(model));
      s.scene.set_v(0, {speed, 0, 0});
      for (int i = 1; i < 200; i++) {
        const Real overlap = 0.01 * std::sin(kPi * i / 200);
        const Real limit = kMu * s.at(overlap, 1e-4).z;
        const Real pull = stiffness_at(model, overlap) * s.scene.springs.spring(0, 0).shear.x;
        EXPECT_GT(pull, 0);
        EXPECT_LE(pull, limit * (1 + 1e-11));
      }
    }
}

TEST(slip, gives_the_spring_no_more_energy_than_it_takes_from_the_sphere)
{
  // Slip of any direction and of speeds over five decades. The overlap only falls with mindlin_slip, whose spring
  // gains where the contact grows. Energies are below 0.4, so rounded by 1e-16.
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> angle(0, 2 * kPi), decade(-4, 1), share(0.2, 1);
  for (TangentialModel model : kSlips) {
    const bool falls = model == TangentialModel::mindlin_slip;
    OneSphere s(sliding(model));
    Real before = 0;
    for (int i = 0; i < 5000; i++) {
      const Real turn = angle(random), speed = std::pow(10, decade(random)), dt = 1e-4;
      const Real overlap = 0.01 * (falls ? 1 - i / 5000.0 : share(random));
      s.scene.set_v(0, {speed * std::cos(turn), speed * std::sin(turn), 0});
      const Vec3 force = s.at(overlap, dt);
      const Real elastic = 0.4 * kK * hertz_radius(overlap) * overlap * overlap;
      const Real stored = s.scene.engine->results().totals().energy - elastic;
      ASSERT_LE(stored - before, -dt * dot(force, s.scene.v(0)) + 1e-13) << i;
      before = stored;
    }
  }
}

TEST(slip, below_the_limit_is_the_model_without_it)
{
  using M = TangentialModel;
  for (auto [with, without] :
       {std::pair(M::linear_history_slip, M::linear_history), {M::mindlin_slip, M::mindlin}}) {
    EngineSettings a = sliding(with), b = sliding(without);
    a.law().mu = b.law().mu = 100;
    OneSphere s(a), other(b);
    for (int i = 1; i < 50; i++)
      for (OneSphere *each : {&s, &other}) {
        each->scene.set_v(0, {std::cos(0.3 * i), std::sin(0.7 * i), 0});
        each->at(0.01, 1e-4);
      }
    EXPECT_EQ(s.scene.force(0), other.scene.force(0));
  }
}

// ---- rolling, twisting, heat ---------------------------------------------------------------------

TEST(rolling, sds_stops_a_rolling_sphere_at_seven_tenths_of_v2_over_mu_g_CPU)
{
  // A contact torque mu_r N R against a sphere that rolls without slipping: 7/5 m v' = -mu_r m g.
  const Real g = 10, mu_roll = 0.05, v = 0.8, dt = 2e-5, k_roll = 2e4;
  EngineSettings law = granular(NormalModel::hooke, kK);
  ContactLaw &p = law.law();
  p.damping = DampingModel::mass_velocity;
  p.eta = 100;
  p.tangential = TangentialModel::linear_history;
  p.k_tangent = 1e5;
  p.xgammat = 1;
  p.mu = 10;
  p.rolling = {RollingModel::sds, {k_roll, 200, mu_roll}};
  Scene scene(floor_mesh(16, 2, 3), kRadius, law);
  scene.add_sphere({-1, 0.13, kRadius - kMass * g / kK}, kRadius, kMass, {v, 0, 0},
                   {0, v / kRadius, 0});
  scene.compute(dt, false);
  for (int i = 0; i < 200000; i++) {
    scene.step(dt, {0, 0, -g});
    if (i * dt > 3) break;
  }
  const Real distance = 0.7 * v * v / (mu_roll * g), shear = mu_roll * kMass * g / k_roll;
  // The springs stretch by mu N/k and hand that back; a hundredth of it stays.
  EXPECT_NEAR(scene.x(0).x, -1 + distance, 5 * shear + 1e-3 * distance);
  EXPECT_NEAR(scene.v(0).x, 0, 1e-6);
  EXPECT_NEAR(scene.x(0).y, 0.13, 1e-9);
}

TEST(twisting, stops_a_spinning_sphere_at_the_angle_of_its_limit_CPU)
{
  // I w^2/2 = M angle: sds with M = mu N, marshall with M = 2/3 a mu N.
  const Real g = 10, w = 3, dt = 2e-5, mu = 0.3,
             overlap = std::cbrt(std::pow(kMass * g / kK, 2) / kRadius);
  const Real a = std::sqrt(kRadius * overlap), inertia = 0.4 * kMass * kRadius * kRadius;
  for (TwistingModel model : {TwistingModel::sds, TwistingModel::marshall}) {
    EngineSettings law = granular(NormalModel::hertz, kK);
    ContactLaw &p = law.law();
    p.damping = DampingModel::mass_velocity;
    p.eta = 300;
    p.tangential = TangentialModel::linear_history;
    p.k_tangent = 1e6;
    p.xgammat = 1;
    p.mu = mu;
    p.twisting = {model, {2e3, 1, 0.01}};
    const Real limit = (model == TwistingModel::sds ? 0.01 : 2.0 / 3 * a * mu) * kMass * g;
    const Real k = model == TwistingModel::sds ? 2e3 : 0.5 * 1e6 * a * a;
    Scene scene(floor_mesh(16, 2, 3), kRadius, law);
    scene.add_sphere({0.1, 0.13, kRadius - overlap}, kRadius, kMass, {0, 0, 0}, {0, 0, w});
    scene.compute(dt, false);
    Real angle = 0, last = w;
    for (int i = 0; i < 400000 && scene.omega(0).z > 0; i++) {
      scene.step(dt, {0, 0, -g});
      angle += dt * 0.5 * (last + scene.omega(0).z);
      last = scene.omega(0).z;
    }
    const Real expected = inertia * w * w / (2 * limit);
    EXPECT_NEAR(angle, expected, limit / k + 1e-3 * expected) << static_cast<int>(model);
    EXPECT_NEAR(norm(scene.v(0)), 0, 1e-9);
  }
}

// A sphere is lifted until its spring exceeds the limit. Whatever the spin is then, in a setup the spring pulls back as much as the limit
// allows.
TEST(twisting, pulls_back_in_a_setup_whatever_the_spin_is)
{
  const Real mu = 0.01;
  EngineSettings law = granular(NormalModel::hertz, kK);
  law.law().tangential = TangentialModel::linear_history;
  law.law().twisting = {TwistingModel::sds, {100, 0, mu}};
  for (const Real spin : {3, 0, -3}) {
    OneSphere s(law);
    s.scene.set_omega(0, {0, 0, 3});
    for (int i = 0; i < 10; i++) s.at(0.01, 1e-4);
    ASSERT_NEAR(s.scene.torque(0).z, -100 * 10 * 1e-4 * 3, 1e-12);    // the spring alone
    s.scene.set_omega(0, {0, 0, spin});
    s.scene.set_x(0, kSpot + Vec3{0, 0, kRadius - 0.0005});
    s.scene.compute(1e-4, false);
    const Real limit = mu * kK * std::sqrt(kRadius) * std::pow(0.0005, 1.5);
    // The height is rounded to 1e-16, 2e-13 of the overlap.
    EXPECT_NEAR(s.scene.torque(0).z, -limit, 1e-12 * limit) << spin;
  }
}

TEST(twisting, marshall_of_a_mindlin_contact_takes_the_stiffness_at_its_size)
{
  // Marshall 2009, equation 32: k_t a a^2/2 with k_t a the tangential stiffness.
  EngineSettings law = with_tangential(TangentialModel::mindlin, 3e4, 100);
  law.law().twisting = TwistingModel::marshall;
  OneSphere s(law);
  const Real overlap = 0.01, a = std::sqrt(kRadius * overlap), angle = 1e-4;
  s.scene.set_omega(0, {0, 0, 1});
  s.at(overlap, angle);
  EXPECT_NEAR(s.scene.torque(0).z, -0.5 * 3e4 * a * a * a * angle, 1e-15);
}

TEST(heat, flows_by_the_radius_or_the_area_of_the_contact)
{
  const Real overlap = 0.01, a = std::sqrt(kRadius * overlap), conductance = 0.7;
  for (HeatModel model : {HeatModel::radius, HeatModel::area}) {
    EngineSettings law = granular(NormalModel::hertz, kK);
    law.law().heat = {model, {conductance}};
    OneSphere s(law);
    s.scene.wall_temperature = 400;
    s.scene.sphere_temperature = 300;
    EXPECT_EQ(s.at(-1e-9).z, 0);
    EXPECT_EQ(s.scene.heat(0), 0);
    s.at(overlap);
    const Real expected =
        model == HeatModel::radius ? 2 * conductance * a : conductance * kPi * a * a;
    EXPECT_NEAR(s.scene.heat(0), 100 * expected, 1e-11);
  }
}

// With and without a share of friction, of a contact that goes on and of one that ends.
TEST(heat, flows_by_no_friction_in_a_step_of_no_time)
{
  for (const Real share : {0., 0.6}) {
    EngineSettings law = with_tangential(TangentialModel::mindlin, 3e4, 0.5);
    law.law().heat = {HeatModel::area, {0.7}};
    law.law().keeps_forces = true;
    law.friction_heat = share;
    OneSphere s(law);
    s.scene.set_v(0, {1, 0, 0});
    s.at(0.01);
    for (const Real overlap : {0.01, -0.01}) {
      s.at(overlap, 0);
      EXPECT_EQ(s.scene.heat(0), 0) << share << " " << overlap;
    }
  }
}

// ---- all of them, over seams ----------------------------------------------------------------------

EngineSettings all_of_granular(NormalModel normal)
{
  EngineSettings settings;
  settings.law() = everything(normal);
  settings.law().surface_energy = 2;
  return settings;
}

TEST(granular, forces_couples_and_heat_do_not_know_of_the_triangles)
{
  // A sphere that slides, rolls, spins and bobs over 512 shuffled triangles, and over
  // two: what a contact keeps goes along over every seam. Rounding of 1e-16 per step and
  // operation, 2000 steps.
  for (NormalModel normal : {NormalModel::hooke, NormalModel::dmt, NormalModel::jkr}) {
    const EngineSettings law = all_of_granular(normal);
    OneSphere fine(law, 16, 9), coarse(law, 1);
    const Real dt = 1e-4;
    for (OneSphere *s : {&fine, &coarse}) {
      s->scene.wall_temperature = 100;
      s->scene.set_x(0, {-1, -0.5, 0});
      s->scene.set_v(0, {6, 4, 0});
      s->scene.set_omega(0, {-3, 9, 2});
    }
    Real off = 0, largest = 0, contact_torque = 0;
    for (int i = 0; i < 2000; i++) {
      const Real overlap = 0.006 + 0.005 * std::sin(i * 0.01);
      for (OneSphere *s : {&fine, &coarse}) {
        s->scene.set_x(0, s->scene.x(0) + dt * s->scene.v(0));
        s->at(overlap, dt);
        if (i % 300 == 299) {
          s->scene.set_v(0, {-s->scene.v(0).y, s->scene.v(0).x, 0});
          s->scene.set_omega(0, {s->scene.omega(0).y, -s->scene.omega(0).x, -2});
        }
      }
      off = std::max({off, norm(fine.scene.force(0) - coarse.scene.force(0)),
                      norm(fine.scene.torque(0) - coarse.scene.torque(0)),
                      std::fabs(fine.scene.heat(0) - coarse.scene.heat(0))});
      largest = std::max(largest, norm(coarse.scene.force(0)));
      contact_torque = std::max(contact_torque, std::fabs(coarse.scene.torque(0).z));
    }
    EXPECT_LE(off, 1e-12 * largest) << static_cast<int>(normal);
    EXPECT_GT(contact_torque, 0);
    ASSERT_EQ(fine.scene.springs.count(0), 1);
    EXPECT_EQ(fine.scene.springs.n_extra(), 5);
  }
}

TEST(granular, a_shallow_fold_bears_heat_and_couples_as_the_flat_wall_does)
{
  // Over the seam of two half-planes 2 degrees apart a sphere has two contacts that share
  // it: contact torques and heat of both, each whole, would be twice the flat wall's. They are its
  // to the fold's angle.
  EngineSettings law = all_of_granular(NormalModel::jkr);
  law.law().mu = 0;    // all torque is contact torques then
  law.law().twisting = {TwistingModel::sds, {0, 0.4, 0.1}};
  Scene fold(hinge_mesh(2, 2), cutoff_of(law.law(), kRadius), law);
  OneSphere flat(law);
  fold.add_sphere({-0.0085, 0.07, kRadius - 0.01}, kRadius, kMass, {1, 0, 0}, {1, 2, 3});
  flat.scene.set_v(0, {1, 0, 0});
  flat.scene.set_omega(0, {1, 2, 3});
  fold.wall_temperature = flat.scene.wall_temperature = 50;
  for (int i = 0; i < 3; i++) {
    flat.at(0.01, 1e-6);
    fold.compute(1e-6);
  }
  ASSERT_EQ(fold.engine->results().totals().contacts, 2);
  EXPECT_NEAR(fold.heat(0), flat.scene.heat(0), 0.1 * flat.scene.heat(0));
  const Vec3 contact_torque = flat.scene.torque(0);
  EXPECT_LE(norm(fold.torque(0) - contact_torque), 0.1 * norm(contact_torque));
}

TEST(granular, two_sheets_at_one_place_bear_heat_and_couples_once)
{
  const EngineSettings law = all_of_granular(NormalModel::jkr);
  TriangleSoup sheets = floor_mesh(3, 2);
  append(sheets, floor_mesh(5, 2));
  Scene twice(sheets, cutoff_of(law.law(), kRadius), law, 0, 0);
  OneSphere once(law);
  twice.add_sphere(kSpot + Vec3{0, 0, kRadius - 0.01}, kRadius, kMass, {1, 0, 0}, {1, 2, 3});
  once.scene.set_v(0, {1, 0, 0});
  once.scene.set_omega(0, {1, 2, 3});
  once.scene.wall_temperature = twice.wall_temperature = 50;
  once.at(0.01);
  twice.compute(1e-6);
  EXPECT_NEAR(norm(twice.force(0) - once.scene.force(0)), 0, 1e-11);
  EXPECT_NEAR(norm(twice.torque(0) - once.scene.torque(0)), 0, 1e-11);
  EXPECT_NEAR(twice.heat(0), once.scene.heat(0), 1e-11);
}

TEST(granular, parameters_and_compiled_laws_agree_on_what_is_kept)
{
  const int first = static_cast<int>(TangentialModel::linear_nohistory);
  int laws = 0;
  for (int normal = 0; normal < 4; normal++)
    for (int tangential = 0; tangential < 8; tangential++)
      for (int more = 0; more < 8; more++) {
        EngineSettings s = granular(static_cast<NormalModel>(normal), kK, 1);
        ContactLaw &g = s.law();
        g.tangential = static_cast<TangentialModel>(first + tangential);
        g.rolling = more & 1 ? RollingModel::sds : RollingModel::none;
        g.twisting = more & 2 ? TwistingModel::sds : TwistingModel::none;
        g.heat = more & 4 ? HeatModel::area : HeatModel::none;
        const LawTraits traits = law_for<CpuBackend>(s).traits;
        laws += traits.history == s.law().has_history() && traits.heat == s.law().has_heat() &&
                traits.n_extra == s.law().n_extra();
      }
  EXPECT_EQ(laws, 4 * 8 * 8);
}

TEST(granular, setup_moves_nothing)
{
  // LAMMPS computes forces again before every run; what is kept must not change by that.
  const EngineSettings law = all_of_granular(NormalModel::jkr);
  OneSphere s(law);
  s.scene.set_v(0, {6, 4, 0});
  s.scene.set_omega(0, {-3, 9, 2});
  for (int i = 0; i < 50; i++) s.at(0.01 - 1e-4 * i, 1e-4);
  const Spring spring = s.scene.springs.spring(0, 0);
  const std::vector<Real> extra = extra_of(s.scene.springs, 0);
  s.scene.compute(1e-4, false);
  EXPECT_EQ(s.scene.springs.spring(0, 0).shear, spring.shear);
  EXPECT_EQ(extra_of(s.scene.springs, 0), extra);
}

TEST(cube_root, is_right_to_a_rounding_or_two_at_all_sizes)
{
  for (Real x = 1e-300; x < 1e300; x *= 1.7)
    ASSERT_LE(std::fabs(cube_root(x) - std::cbrt(x)), 4 * kRoundoff * std::cbrt(x)) << x;
  EXPECT_EQ(cube_root(0), 0);
  EXPECT_EQ(cube_root(1), 1);
}

}    // namespace
}    // namespace lsdcd::test_granular
