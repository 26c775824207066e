// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A bed of spheres at rest in a drum that stands upright, for a million steps.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/pair_force.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace lsdcd::test_bed {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kSteps = 100000;
#else
constexpr int kSteps = 1000000;
#endif

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 1, kGravity = 10, kDt = 1e-4;
constexpr Real kGamma = 200, kTangent = 2 * kStiffness / 7, kMu = 0.5;
constexpr int kSpheres = 30, kSettling = 200000;

Real kinetic(const Scene &scene)
{
  Real e = 0;
  for (int i = 0; i < scene.n(); i++)
    e += 0.5 * kMass * norm_sq(scene.v(i)) +
         0.2 * kMass * kRadius * kRadius * norm_sq(scene.omega(i));
  return e;
}

TEST(bed, comes_to_rest_and_stays_and_the_mesh_bears_its_weight)
{
  Scene scene(cylinder_mesh(32, 3, 1.55, 12), kRadius,
              hooke_history(kStiffness, kTangent, kGamma, kGamma, kMu));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> off(-0.02, 0.02);
  // Four a layer, every other one turned, let fall from just above each other.
  for (int i = 0; i < kSpheres; i++) {
    const Real a = kPi / 2 * (i % 4) + 0.8 * (i / 4);
    scene.add_sphere({0.75 * std::cos(a) + off(random), 0.75 * std::sin(a) + off(random),
                      0.6 + 1.1 * (i / 4) + off(random)},
                     kRadius, kMass);
  }
  PairForce pairs(kSpheres, {kStiffness, kGamma, kTangent, kGamma, kMu});
  // Nothing in these laws slows down a sphere that twists on a contact, or spheres that
  // turn like gears: a drag does, until all rest.
  bool drag = true;
  scene.more_forces = [&](Scene &s, Real dt) {
    pairs.add(s, dt);
    const Real rate = 5;
    for (int i = 0; drag && i < s.n(); i++)
      s.add_force(i, -rate * kMass * s.v(i), -rate * 0.4 * kMass * kRadius * kRadius * s.omega(i));
  };
  scene.compute(kDt);
  for (int step = 0; step < kSettling; step++) scene.step(kDt, {0, 0, -kGravity});
  drag = false;
  Real largest = 0;
  for (int step = 0; step < kSteps; step++) {
    scene.step(kDt, {0, 0, -kGravity});
    if (step >= 10000) largest = std::fmax(largest, kinetic(scene));
  }

  Vec3 weight = {0, 0, 0}, moment = {0, 0, 0};
  Real farthest = 0;
  for (int i = 0; i < scene.n(); i++) {
    const Vec3 w = {0, 0, -kMass * kGravity};
    weight += w;
    moment += cross(scene.x(i), w);
    for (int k = 0; k < 3; k++) farthest = std::fmax(farthest, std::fabs(scene.x(i)[k]));
  }
  const WallTotals &t = scene.engine->results().totals();
  const Real rounding = std::nextafter(farthest, HUGE_VAL) - farthest, still = rounding / kDt;
  const std::string name = std::to_string(kSpheres) + " spheres in an upright drum, ";
  expect_at_most(
      {"Energy", "20a",
       name + "largest kinetic energy in " + std::to_string(kSteps) + " steps without drag"},
      largest, kSpheres * 0.5 * kMass * (1 + 0.4) * 3 * still * still,
      "a speed below one rounding of a coordinate a step moves nothing: all six "
      "components of all spheres at that speed");
  const Real force = kStiffness * rounding * t.contacts;
  expect_at_most({"Energy", "20b", name + "|F on the mesh - weight| over weight"},
                 norm(t.force - weight) / norm(weight), force / norm(weight),
                 "k times a rounding of a coordinate at every contact");
  expect_at_most(
      {"Energy", "20c", name + "|torque on the mesh - moment of the weights| over weight R"},
      norm(t.torque - moment) / (norm(weight) * kRadius),
      force * farthest / (norm(weight) * kRadius), "the same at an arm of the largest coordinate");
}

}    // namespace
}    // namespace lsdcd::test_bed
