// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Funnels and cones of 3 to 12 planes: the force follows a sphere's position without a jump, whichever of the planes
// bear it, and a sphere that bounces in a funnel keeps its energy. With
// LSDCD_QUICK one random cone of each number of planes and 20 000 steps of bouncing: 2 seconds, else 20.
#include "support/cover.h"
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_funnels {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kDepth = 0.02 * kRadius;
constexpr const char *kTheme = "Funnels and cones";

struct Plane {
  Vec3 normal;
  Real overlap;    // of a sphere at the origin
};

Vec3 unit_of(Real tilt, Real around)
{
  return {std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt)};
}

// Equally overlapped planes all round z, tilted by `degrees`.
std::vector<Plane> regular(int n, Real degrees)
{
  std::vector<Plane> out;
  for (int i = 0; i < n; i++)
    out.push_back({unit_of(degrees * kPi / 180, 2 * kPi * i / n), kDepth});
  return out;
}

// Planes in random directions tilted by up to `degrees`, their overlaps within 30 %.
std::vector<Plane> uneven(int n, Real degrees, Random &random)
{
  std::vector<Plane> out;
  for (int i = 0; i < n; i++)
    out.push_back({unit_of(degrees * kPi / 180 * std::sqrt(uniform(random, 0, 1)),
                           uniform(random, 0, 2 * kPi)),
                   kDepth * (1 + 0.3 * uniform(random, -1, 1))});
  return out;
}

// Each plane is one triangle, whose edges are farther than the sphere reaches.
TriangleSoup mesh_of(const std::vector<Plane> &planes)
{
  TriangleSoup soup;
  soup.source = "cone";
  for (const Plane &p : planes) {
    const Vec3 foot = (p.overlap - kRadius) * p.normal;
    const Vec3 aside = std::fabs(p.normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    const Vec3 s = cross(p.normal, aside), a = (1 / norm(s)) * s, b = cross(p.normal, a);
    for (int k = 0; k < 3; k++)
      soup.corners.push_back(foot +
                             4 * (std::cos(2 * kPi * k / 3) * a + std::sin(2 * kPi * k / 3) * b));
  }
  return soup;
}

constexpr int kSteps = 400;

// Forces along a straight way of the length `way` from `from` on.
std::vector<Vec3> forces(const TriangleSoup &soup, const EngineSettings &law, const Vec3 &from,
                         const Vec3 &way)
{
  Scene scene(soup, kRadius, law, 0, 0);
  for (int i = 0; i <= kSteps; i++) scene.add_sphere(from + Real(i) / kSteps * way, kRadius, kMass);
  scene.compute(1e-4);
  std::vector<Vec3> out;
  for (int i = 0; i <= kSteps; i++) out.push_back(scene.force(i));
  return out;
}

// The largest change of the force over a step of `way` / kSteps^4, which is looked for where the force changes most
// over steps kSteps, kSteps^2 and kSteps^3 times as long; as a part of the largest force.
Real jump(const TriangleSoup &soup, const EngineSettings &law, Vec3 from, Vec3 way)
{
  Real largest_force = 0, change = 0;
  for (int level = 0; level < 4; level++) {
    const std::vector<Vec3> f = forces(soup, law, from, way);
    int at = 1;
    for (int i = 0; i <= kSteps; i++) {
      largest_force = std::fmax(largest_force, norm(f[i]));
      if (i > 0 && norm(f[i] - f[i - 1]) > norm(f[at] - f[at - 1])) at = i;
    }
    change = norm(f[at] - f[at - 1]);
    from += Real(at - 1) / kSteps * way;
    way = Real(1) / kSteps * way;
  }
  return change / largest_force;
}

// The last step is 0.08 R / 400^4 = 3e-12 R, or 1.6e-10 of the overlap. A force whose slope is up to 60 times that of
// one wall changes by 1e-8 over it; a jump stays.
constexpr Real kJump = 1e-8;
constexpr const char *kWhy = "slopes of up to 60 k over a step of 3e-12 R; a jump would stay";

EngineSettings hertz(Real k)
{
  return hertz_history(k, 0, 0, 0, 0);
}

void expect_no_jump(const std::string &name, const std::vector<std::vector<Plane>> &cones)
{
  const bool upright[] = {false, true};
  Random random(3);
  Real largest[2] = {0, 0};
  for (const std::vector<Plane> &planes : cones) {
    const TriangleSoup soup = mesh_of(planes);
    for (bool along : upright) {
      const Vec3 direction = along ? Vec3{0.02, 0.05, 1} : random_unit(random);
      const Vec3 way = 0.08 * kRadius / norm(direction) * direction;
      const Vec3 from = 0.003 * kRadius * random_unit(random) - 0.5 * way;
      largest[0] = std::fmax(largest[0], jump(soup, hooke(kStiffness), from, way));
      largest[1] = std::fmax(largest[1], jump(soup, hertz(kStiffness), from, way));
    }
  }
  expect_at_most({kTheme, "30", name + ", hooke: largest |dF| of a step / F"}, largest[0], kJump,
                 kWhy);
  expect_at_most({kTheme, "30", name + ", hertz: largest |dF| of a step / F"}, largest[1], kJump,
                 kWhy);
}

TEST(cone, of_equal_planes_has_a_continuous_force)
{
  // A rule with several local solutions jumps by 24 and 9 % with seven planes at 80 and 60 degrees, and by 11 % with twelve at
  // 45 degrees and hertz. For four an offset decides which three bear: below.
  for (auto [n, degrees] :
       std::vector<std::pair<int, Real>>{{4, 27}, {4, 45}, {7, 80}, {7, 60}, {12, 45}, {12, 60}})
    expect_no_jump(std::to_string(n) + " planes at " + std::to_string(int(degrees)) + " degrees",
                   {regular(n, degrees)});
}

TEST(cone, of_random_planes_has_a_continuous_force)
{
  Random random(4);
  const int n_cones = std::getenv("LSDCD_QUICK") ? 1 : 12;
  for (int n = 3; n <= 12; n++) {
    std::vector<std::vector<Plane>> cones;
    for (int k = 0; k < n_cones; k++) cones.push_back(uneven(n, 85, random));
    expect_no_jump(std::to_string(n) + " random planes up to 85 degrees", cones);
  }
}

TEST(cone, that_an_offset_takes_through_one_point_has_a_continuous_force)
{
  // Four planes meet in a point; one that is 1e-12 R off to either side turns the sign of what decides which three bear
  // the sphere.
  for (Real degrees : {27., 45.}) {
    std::vector<Vec3> f[2];
    for (int side = 0; side < 2; side++) {
      std::vector<Plane> planes = regular(4, degrees);
      planes[0].overlap += (side ? 1 : -1) * 1e-12 * kRadius;
      f[side] = forces(mesh_of(planes), hertz(kStiffness), {-0.005 * kRadius, 0.002 * kRadius, 0},
                       {0.01 * kRadius, 0.003 * kRadius, 0});
    }
    Real largest = 0, largest_force = 0;
    for (int i = 0; i <= kSteps; i++) {
      largest = std::fmax(largest, norm(f[1][i] - f[0][i]));
      largest_force = std::fmax(largest_force, norm(f[0][i]));
    }
    // Shares change by 2e-12 R over the least eigenvalue of the covers, that of + - + -; doc/theory.md.
    const Real sine_sq = std::pow(std::sin(degrees * kPi / 180), 2);
    const Real least = 1 - 2 * cover_of(1 - sine_sq) + cover_of(1 - 2 * sine_sq);
    const Real bound = 2 * 2e-12 * kRadius / least / kDepth;
    expect_at_most({kTheme, "31",
                    "4 planes at " + std::to_string(int(degrees)) +
                        " degrees, one moved by 2e-12 R, hertz: |dF| / F"},
                   largest / largest_force, bound,
                   "2 |dd| / (d times the least eigenvalue of the covers)");
  }
}

// A sphere bounces in a funnel without damping: the largest change of its energy in flight, as a part of that at
// the start.
struct Bounces {
  Real drift = 0;
  int n = 0;
};
Bounces bounce(const std::vector<Plane> &planes, int n_steps, Real w)
{
  Scene scene(mesh_of(planes), kRadius, hooke(kStiffness));
  const Real dt = w / std::sqrt(kStiffness / kMass), g = 10;
  scene.add_sphere({0.02, 0.01, 0.25}, kRadius, kMass);
  scene.compute(dt);
  const auto energy = [&] { return 0.5 * norm_sq(scene.v(0)) + g * scene.x(0).z; };
  const Real start = energy();
  Bounces out;
  bool touched = false;
  for (int step = 0; step < n_steps; step++) {
    scene.step(dt, {0, 0, -g});
    const bool touches = norm_sq(scene.force(0)) > 0;
    out.n += touches && !touched;
    touched = touches;
    if (!touches) out.drift = std::fmax(out.drift, std::fabs(energy() / start - 1));
  }
  return out;
}

TEST(funnel, keeps_the_energy_of_a_sphere_that_bounces_CPU)
{
  // As the billiard of test_energy: a touch that begins or ends within a step changes the energy of motion by
  // w^2 / sqrt(90) at random, and bounces add up as their root. Seven planes all round are more than a convex problem
  // has room for; what they do there is no gradient (doc/theory.md), here 0.2 % a bounce at most, at random. A rule
  // that jumps gains 13 % in 800 bounces of the last funnel, and more later.
  const Real w = 0.0307;
  const int n_steps = std::getenv("LSDCD_QUICK") ? 20000 : 400000;
  struct Funnel {
    int n;
    Real degrees, a_bounce;
    const char *why;
  };
  const Real touch = w * w / std::sqrt(90.);
  for (const Funnel &f :
       {Funnel{4, 27, 5 * touch,
               "five deviations: w^2 / sqrt(90) a bounce, times the root of their number"},
        Funnel{5, 60, 5 * touch,
               "five deviations: w^2 / sqrt(90) a bounce, times the root of their number"},
        Funnel{7, 60, 2e-3, "0.2 % a bounce, times the root of their number"},
        Funnel{7, 80, 2e-3, "0.2 % a bounce, times the root of their number"}}) {
    const Bounces b = bounce(regular(f.n, f.degrees), n_steps, w);
    EXPECT_GT(b.n, n_steps / 2000);
    expect_at_most({kTheme, "32",
                    "a sphere bounces in " + std::to_string(f.n) + " planes at " +
                        std::to_string(int(f.degrees)) + " degrees, " + std::to_string(n_steps) +
                        " steps: largest |E/E0 - 1|"},
                   b.drift, f.a_bounce * std::sqrt(Real(b.n)), f.why);
  }
}

}    // namespace
}    // namespace lsdcd::test_funnels
