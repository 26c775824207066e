// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How long contacts and surface waves last, against the motion itself.
#include "law/contact_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lsdcd::test_contact_time {
namespace {

struct Motion {
  double overlap, time;
};

// A mass that meets a spring of force(overlap, speed), followed by velocity Verlet until it lets go.
template <class Force>
Motion follow(double mass, double speed, double dt, Force force)
{
  double x = 0, v = speed, deepest = 0;
  double a = force(x, v) / mass;
  for (int step = 1;; step++) {
    v += 0.5 * dt * a;
    const double before = x;
    x += dt * v;
    if (x < 0) return {deepest, dt * (step - 1 + before / (before - x))};
    a = force(x, v) / mass;
    v += 0.5 * dt * a;
    deepest = std::max(deepest, x);
  }
}

// Verlet with n steps in a contact is wrong by (pi / n)^2 / 24 of a period: 4e-8 with the 3000 and
// more here. Where a Hertz force begins its slope is not smooth: another 1 / n^(3/2), 6e-6.
constexpr double kTolerance = 1e-5;

TEST(ContactTime, of_a_hertz_impact_is_that_of_its_motion)
{
  for (const double speed : {0.01, 1.0, 16.0}) {
    const double modulus = 3e6, mass = 1e-4, radius = 0.002;
    const HertzImpact got = hertz_impact(modulus, mass, radius, speed);
    const Motion is = follow(mass, speed, got.time / 10000, [&](double x, double) {
      return -4.0 / 3 * modulus * std::sqrt(radius) * std::pow(std::max(0.0, x), 1.5);
    });
    EXPECT_NEAR(got.time / is.time, 1, kTolerance);
    EXPECT_NEAR(got.overlap / is.overlap, 1, kTolerance);
  }
}

// A sphere of m = 0.1 and R = 2 turns on a spring of torque k: half a period is pi sqrt(2/5 m R^2/k) = 0.4 pi/sqrt(k).
TEST(ContactTime, is_no_longer_than_half_a_period_of_rolling)
{
  ContactLaw law = granular_law(NormalModel::hooke);
  law.k_normal = 1000;
  law.tangential = TangentialModel::linear_history;
  law.k_tangent = 900;
  const double of_normal = contact_time(law, 0.1, 2, 1);
  const struct {
    Chosen<RollingModel> rolling;
    double torque;
  } rows[] = {{{RollingModel::sds, {3000, 0, 1}}, 3000 * 4},
              {{RollingModel::epsd2, {0.1}}, 900 * 4},
              {{RollingModel::epsd, {2, 0}}, 2.25 * 1000 * 4 * 4},
              {{RollingModel::epsd3, {2, 0, 9}}, 9.0 * 1000 * 4 * 4}};
  for (const auto &row : rows) {
    law.rolling = row.rolling;
    EXPECT_DOUBLE_EQ(contact_time(law, 0.1, 2, 1), 0.4 * kPi / std::sqrt(row.torque));
    // Of two spheres, by what turns: here a quarter of it.
    EXPECT_DOUBLE_EQ(contact_time(law, 0.1, 2, 1, 0.04), 0.2 * kPi / std::sqrt(row.torque));
  }
  for (const Chosen<RollingModel> &slow :
       {Chosen<RollingModel>{RollingModel::cdt, {5}}, {RollingModel::epsd, {0.1, 0}}}) {
    law.rolling = slow;
    EXPECT_DOUBLE_EQ(contact_time(law, 0.1, 2, 1), of_normal);
  }
}

TEST(ContactTime, of_a_linear_spring_is_half_a_period)
{
  ContactLaw law = classic_law(NormalModel::hooke, false);
  law.k_normal = 1000;
  EXPECT_DOUBLE_EQ(contact_time(law, 0.1, 7, 1), kPi / 100);
  // Damping of m gamma v: omega^2 less gamma^2/4. 100^2 - 60^2 = 80^2.
  law.eta = 120;
  EXPECT_NEAR(contact_time(law, 0.1, 7, 1), kPi / 80, 1e-16);
}

TEST(ContactTime, of_a_hertz_spring_is_that_at_an_overlap_of_1_percent)
{
  ContactLaw law = granular_law(NormalModel::hertz);
  law.k_normal = 4e6;
  // Slope at overlap 0.01 R: 1.5 k sqrt(0.01) R = 0.15 k R; units where force per mass is 4 accelerations.
  EXPECT_NEAR(contact_time(law, 0.3, 0.002, 4), kPi / std::sqrt(4 * 0.15 * 4e6 * 0.002 / 0.3),
              1e-12);
}

TEST(ContactTime, of_a_rayleigh_wave_solves_its_equation)
{
  // The speed of the wave is a root of Rayleigh's equation, r^3 - 8 r^2 + (24 - 16 q) r - 16 (1 - q) = 0,
  // r = (c / c_shear)^2, q = (1 - 2 nu) / (2 (1 - nu)). The line in nu is right to 1 % between nu = 0.1
  // and 0.45.
  for (const double nu : {0.1, 0.2, 0.3, 0.45}) {
    const double q = (1 - 2 * nu) / (2 * (1 - nu));
    double lo = 0.5, hi = 1;
    for (int i = 0; i < 60; i++) {
      const double r = 0.5 * (lo + hi);
      (r * r * r - 8 * r * r + (24 - 16 * q) * r - 16 * (1 - q) < 0 ? lo : hi) = r;
    }
    const double density = 2500, shear = 2e6, radius = 0.002;
    const double wave = std::sqrt(lo * shear / density);
    EXPECT_NEAR(rayleigh_time(radius, density, 2 * (1 + nu) * shear, nu) * wave / (kPi * radius), 1,
                0.01);
  }
}

}    // namespace
}    // namespace lsdcd::test_contact_time
