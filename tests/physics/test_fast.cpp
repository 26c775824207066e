// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Fast spheres: what speed goes through a wall, and what `side` brings back. Thin plates.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lsdcd::test_fast {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2;
const Vec3 kNoGravity = {0, 0, 0};

EngineSettings sided(Side side)
{
  EngineSettings s = hooke(kStiffness);
  s.side = side;
  return s;
}

// ---- how fast is too fast ------------------------------------------------------------------

struct Target {
  const char *name;
  TriangleSoup soup;
  Vec3 p, n;    // a point of the wall, and the normal along which it is hit
  Side side;
};

// Does it turn round, or get to where nothing pulls it back: past the wall where the
// wall has no side, a radius past it where it has one?
bool returns(const Target &t, Real speed, Real w)
{
  Scene scene(t.soup, kRadius, sided(t.side));
  const Real dt = w / std::sqrt(kStiffness / kMass);
  scene.add_sphere(t.p + (kRadius + 0.3 * dt * speed) * t.n, kRadius, kMass, -speed * t.n);
  scene.compute(dt);
  for (int i = 0; i < static_cast<int>(20 / w); i++) {
    scene.step(dt, kNoGravity);
    if (dot(scene.x(0) - t.p, t.n) < (t.side == Side::both ? 0 : -kRadius)) return false;
    if (dot(scene.v(0), t.n) > 0) return true;
  }
  ADD_FAILURE() << "still on its way";
  return false;
}

// The speed between coming back and going through, by bisection.
Real critical_speed(const Target &t, Real guess, Real w)
{
  Real lo = 0.5 * guess, hi = 1.5 * guess;
  EXPECT_TRUE(returns(t, lo, w)) << t.name;
  EXPECT_FALSE(returns(t, hi, w)) << t.name;
  for (int i = 0; i < 24; i++) (returns(t, (lo + hi) / 2, w) ? lo : hi) = (lo + hi) / 2;
  return lo;
}

TEST(fast, sphere_goes_through_at_r_root_of_k_over_m_and_with_a_side_at_twice_that)
{
  const Real w = 0.005, v = kRadius * std::sqrt(kStiffness / kMass);
  const TriangleSoup floor = floor_mesh(4, 2), box = box_mesh({0, 0, 0}, {4, 4, 4});
  const Vec3 up = {0, 0, 1};
  const Target targets[] = {{"side both, a face", floor, {0.3, 0.1, 0}, up, Side::both},
                            {"side both, an edge", floor, {0.5, 0, 0}, up, Side::both},
                            {"side both, a vertex", floor, {0, 0, 0}, up, Side::both},
                            {"side both, a face of a box", box, {2.1, 1.7, 4}, up, Side::both},
                            {"side out, a face of a box", box, {2.1, 1.7, 4}, up, Side::out},
                            {"side out, a diagonal of a box", box, {2, 2, 4}, up, Side::out},
                            {"side in, a face of a box", box, {2.1, 1.7, 4}, -up, Side::in},
                            {"side in, a diagonal of a box", box, {2, 2, 4}, -up, Side::in}};
  for (const Target &t : targets) {
    const bool kept = t.side != Side::both;
    expect_answer({"Fast and thin", "19a", std::string(t.name) + ": speed that goes through"},
                  kept ? 2 * v : v, critical_speed(t, kept ? 2 * v : v, w),
                  w * w / 2 * (kept ? 2 * v : v),
                  kept ? "m v^2 = k (2R)^2: the spring goes on to radius + distance, up to 2 R; "
                         "leapfrog and its steps at the turn: (dt sqrt(k/m))^2 / 2"
                       : "m v^2 = k R^2: the spring turns round where the centre crosses; leapfrog "
                         "and its steps at the turn: (dt sqrt(k/m))^2 / 2");
  }
}

TEST(fast, sphere_that_skips_a_wall_in_one_step_is_not_seen)
{
  // Unseen if one step takes it from no overlap to no overlap: v dt >= 2 R at best.
  for (const Side side : {Side::both, Side::in}) {
    const Real dt = 1e-3;
    Real slowest = HUGE_VAL;
    Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(side));
    scene.add_sphere({2, 2, 2}, kRadius, kMass);
    for (int i = 0; i < 2000; i++) {
      const Real step = kRadius * (1.5 + i * 0.0005), gap = 1e-9;    // just out of touch
      scene.set_x(0, {2.1, 1.7, 4 - kRadius - gap});
      scene.set_v(0, {0, 0, step / dt});
      scene.compute(dt);
      scene.step(dt, kNoGravity);
      if (norm_sq(scene.force(0)) == 0) {
        slowest = std::fmin(slowest, step);
        break;
      }
    }
    expect_answer({"Fast and thin", "19b",
                   std::string(side == Side::both ? "side both" : "side in") +
                       ": step over R that jumps a wall unseen"},
                  2, slowest / kRadius, 0.0005 + 1e-8,
                  "from R above to R below; speeds are tried 0.0005 R a step apart");
  }
}

TEST(fast, spheres_in_a_box_with_side_in_all_come_back)
{
  // At 1.2 times the speed that goes through a wall that has no side, against faces,
  // edges and corners at all angles. Into a corner they sink less: three springs act.
  const Real w = 0.02, dt = w / std::sqrt(kStiffness / kMass);
  const Real v = 1.2 * kRadius * std::sqrt(kStiffness / kMass);
  for (const Side side : {Side::in, Side::both}) {
    Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, sided(side));
    std::mt19937_64 random(7);
    std::normal_distribution<Real> normal;
    constexpr int kSpheres = 500;
    for (int i = 0; i < kSpheres; i++) {
      const Vec3 d = {normal(random), normal(random), normal(random)};
      scene.add_sphere({2, 2, 2}, kRadius, kMass, (v / norm(d)) * d);
    }
    scene.compute(dt);
    for (int i = 0; i < 4000; i++) scene.step(dt, kNoGravity);
    int out = 0;
    Real fastest = 0;
    for (int i = 0; i < kSpheres; i++) {
      const Vec3 x = scene.x(i);
      for (int k = 0; k < 3; k++)
        if (x[k] < -kRadius || x[k] > 4 + kRadius) {
          out++;
          break;
        }
      fastest = std::fmax(fastest, norm(scene.v(i)) / v);
    }
    if (side == Side::in) {
      expect_answer({"Fast and thin", "19c",
                     "500 spheres at 1.2 R sqrt(k/m) in a box, side in, about "
                     "15 bounces each: spheres lost"},
                    0, out, 0, "1.2 < 2, the bound of 19a");
    } else {
      expect_at_least(
          {"Fast and thin", "19d", "the same with side both: spheres lost"}, out, 200,
          "a face lets all through that hit it at more than R sqrt(k/m): half of all at "
          "the first hit, give or take 11");
    }
  }
}

// ---- thin plates ------------------------------------------------------------------------------

TEST(thin_plate, of_a_thousandth_of_a_radius_is_one_contact)
{
  const Real t = 1e-3 * kRadius;
  const TriangleSoup plate = box_mesh({-2, -2, -t}, {2, 2, 0});
  for (const Side side : {Side::both, Side::out}) {
    Scene scene(plate, kRadius, sided(side));
    std::mt19937_64 random(4);
    std::uniform_real_distribution<Real> flat(-2.4, 2.4), depth(-3, -0.5);
    for (int i = 0; i < 20000; i++) {
      const Real h = kRadius * (1 - std::pow(10., depth(random)));
      scene.add_sphere({flat(random), flat(random), i % 2 ? h : -t - h}, kRadius, kMass);
    }
    scene.compute(1e-4, true, true);
    Real off = 0, most = 0;
    for (int k = 0; k < scene.engine->results().n_touching(); k++) {
      const int i = scene.engine->results().touching()[k].sphere;
      const Vec3 x = scene.x(i), f = scene.force(i);
      const Vec3 closest = {std::clamp(x.x, -2., 2.), std::clamp(x.y, -2., 2.), x.z > 0 ? 0 : -t};
      const Real d = norm(x - closest);
      const Vec3 answer = (kStiffness * (kRadius - d) / d) * (x - closest);
      off = std::fmax(off, norm(f - answer) / (kStiffness * kRadius));
      most = std::fmax(most, scene.engine->results().touching()[k].n_contacts);
    }
    EXPECT_GT(scene.engine->results().n_touching(), 10000);
    const std::string name =
        std::string("closed plate of 1e-3 R, side ") + (side == Side::both ? "both" : "out");
    expect_at_most({"Fast and thin", "07a", name + ": largest |F - k overlap| over k R"}, off,
                   16 * kRoundoff, "distances round by a few 1e-16");
    expect_answer({"Fast and thin", "07b", name + ": most contacts that bear"}, 1, most, 0,
                  "the far face is behind the near one");
  }
}

}    // namespace
}    // namespace lsdcd::test_fast
