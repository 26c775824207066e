// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Energy over long runs, and the largest time step.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace lsdcd::test_energy {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2;

// Sanitizers slow the loops down tenfold and more.
#if defined(__SANITIZE_ADDRESS__)
constexpr int kLong = 50000;
#else
constexpr int kLong = 1000000;
#endif

// ---- billiard ----------------------------------------------------------------------------------

TEST(billiard, in_a_mesh_box_keeps_its_energy_for_a_million_steps_CPU_LONG)
{
  // Not a whole part of a contact: else losses and gains at its ends cancel.
  const Real w = 0.0307, dt = w / std::sqrt(kStiffness / kMass);
  Scene scene(box_mesh({0, 0, 0}, {3, 2, 2.5}), kRadius, hooke(kStiffness));
  const std::vector<Vec3> start = {{7, 4, 5.5}, {-3, 9, 1}, {8, 0.02, -6}, {1e-3, -5, 5}};
  for (const Vec3 &v : start) scene.add_sphere({1, 0.9, 1.1}, kRadius, kMass, v);
  scene.compute(dt);
  const int n = scene.n();
  std::vector<Real> drift(n, 0), bounces(n, 0);
  std::vector<bool> touched(n, false);
  for (int step = 0; step < kLong; step++) {
    scene.step(dt, {0, 0, 0});
    for (int i = 0; i < n; i++) {
      const bool touches = norm_sq(scene.force(i)) > 0;
      if (touches && !touched[i]) bounces[i]++;
      touched[i] = touches;
      // In flight all energy is kinetic.
      if (!touches)
        drift[i] = std::fmax(drift[i], std::fabs(norm_sq(scene.v(i)) / norm_sq(start[i]) - 1));
    }
  }
  for (int i = 0; i < n; i++) {
    char name[120];
    std::snprintf(name, sizeof name, "billiard in a box, v = (%g %g %g), %d steps, %d bounces",
                  start[i].x, start[i].y, start[i].z, kLong, static_cast<int>(bounces[i]));
    EXPECT_GT(bounces[i], kLong / 1000);
    // A touch that begins the share a of a step early changes the energy by
    // -w^2 a (1 - a), one that ends so by as much the other way (the harmonic
    // oscillator's leapfrog keeps v^2 + (k/m)(1 - w^2/4) x^2). With a at random the
    // two have the deviation w^2 / sqrt(90), and bounces add up as their root.
    expect_at_most({"Energy", "18", std::string(name) + ": largest |E/E0 - 1|"}, drift[i],
                   5 * w * w / std::sqrt(90.) * std::sqrt(bounces[i]),
                   "five deviations: w^2 / sqrt(90) a bounce, w = dt sqrt(k/m) = 0.0307, times "
                   "the root of their number");
  }
}

// ---- the largest time step ----------------------------------------------------------------------

// A hinge's right half rises by `degrees`; gravity is upright.
struct Rest {
  const char *name;
  TriangleSoup soup;
  Vec3 at;    // the centre of a sphere that touches without overlap
};

std::vector<Rest> rests()
{
  const Real one = kPi / 180;
  return {
      {"a face", floor_mesh(4, 2), {0.3, 0.1, kRadius}},
      {"a vertex", floor_mesh(4, 2), {0, 0, kRadius}},
      {"a fold of 1 degree", hinge_mesh(1, 3), {-kRadius * std::tan(one / 2), 0.1, kRadius}},
      {"a fold of 30 degrees", hinge_mesh(30, 3), {-kRadius * std::tan(15 * one), 0.1, kRadius}}};
}

struct Shake {
  Real largest;    // excursion from rest over the first one
  Real growth;     // of the excursion per step at the end
};

// A sphere at rest, pushed off by a small excursion upright and left alone for n steps.
Shake shake(const Rest &rest, Real w, int n, Corner corner = Corner::blend)
{
  EngineSettings law = hooke(kStiffness);
  law.corner = corner;
  Scene scene(rest.soup, kRadius, law);
  const Real dt = w / std::sqrt(kStiffness / kMass), sunk = 1e-3, off = 1e-9;
  // Gravity is what the wall answers with at this depth.
  scene.add_sphere(rest.at - Vec3{0, 0, sunk}, kRadius, kMass);
  scene.compute(dt, false);
  const Vec3 gravity = (-1 / kMass) * scene.force(0);
  const Vec3 middle = scene.x(0);
  scene.set_x(0, middle + Vec3{0, 0, off});
  scene.compute(dt, false);
  Shake s = {0, 0};
  Real last = 0;
  for (int i = 0; i < n; i++) {
    scene.step(dt, gravity);
    const Real now = norm(scene.x(0) - middle);
    s.largest = std::fmax(s.largest, now / off);
    s.growth = now / last;
    last = now;
    if (now > 0.1 * sunk) break;    // beyond this it takes off
  }
  return s;
}

TEST(time_step, of_two_over_the_root_of_k_over_m_is_the_largest)
{
  std::printf("  undamped hooke: dt < 2 / sqrt(k/m) = %.6g s for k = %g, m = %g\n",
              2 / std::sqrt(kStiffness / kMass), kStiffness, kMass);
  for (const Rest &rest : rests()) {
    const Real below = 1.98, above = 2.02;
    const std::string name = std::string("at rest on ") + rest.name;
    expect_at_most(
        {"Time step", "22a",
         name + ", dt = 0.99 of 2 / sqrt(k/m): largest excursion over the first"},
        shake(rest, below, 20000).largest, 1.01 / std::sqrt(1 - below * below / 4),
        "leapfrog at w = dt sqrt(k/m) < 2 swings up to 1 / sqrt(1 - w^2/4); a blended fold has the "
        "stiffness k of one wall in every direction");
    const Real half = above * above / 2;
    expect_answer({"Time step", "22b", name + ", dt = 1.01 of it: growth per step"},
                  half - 1 + std::sqrt((half - 1) * (half - 1) - 1),
                  shake(rest, above, 20000).growth, 1e-6,
                  "root of z^2 + (w^2 - 2) z + 1 beyond 1; the other root has died out; "
                  "roundings of 1e-16 were 1e-7 of the first excursion and fade like it");
  }
}

TEST(time_step, under_the_plain_sum_is_smaller_at_a_fold)
{
  // Two springs act where one wall is: stable on a face is not stable in the fold.
  const Rest fold = rests()[2];
  expect_at_least({"Time step", "22c",
                   "at rest on a fold of 1 degree, corner sum, dt = 0.99 of 2 / sqrt(k/m): growth "
                   "per step"},
                  shake(fold, 1.98, 20000, Corner::sum).growth, 2,
                  "two walls have 2 k: w^2 = 7.8, growth 5.6; what corner blend avoids");
}

}    // namespace
}    // namespace lsdcd::test_energy
