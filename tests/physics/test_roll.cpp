// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rolling: down inclines, along grooves, over seams and over the tip of a cone.
#include "support/cover.h"
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <array>
#include <cmath>

namespace lsdcd::test_roll {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kGravity = 10, kDt = 5e-5;
constexpr Real kGamma = 60, kTangent = 4e4;

Real radians(Real degrees)
{
  return degrees * kPi / 180;
}

EngineSettings law(bool history, Real mu)
{
  return history ? hooke_history(kStiffness, kTangent, kGamma, kGamma, mu)
                 : hooke(kStiffness, kGamma, 50 * kGamma, mu);
}

struct Rolled {
  Real acceleration, spin_up;    // along the way, between 0.3 s and 0.6 s
  Real lift, aside;              // largest change of height, and to the side
};

// A sphere let go at rest; it has settled into rolling or sliding after 0.3 s,
// when exp(-7/2 kGamma/2 0.3) = 2e-14 of the start is left in the tangential spring.
Rolled let_go(const TriangleSoup &soup, const EngineSettings &settings, const Vec3 &x,
              const Vec3 &gravity, const Vec3 &along)
{
  Scene scene(soup, kRadius, settings);
  scene.add_sphere(x, kRadius, kMass);
  scene.compute(kDt, false);
  const Vec3 up = {0, 0, 1}, aside = cross(up, along);
  Rolled r = {0, 0, 0, 0};
  Vec3 v = {0, 0, 0}, omega = {0, 0, 0};
  const int half = static_cast<int>(std::lround(0.3 / kDt));
  for (int i = 1; i <= 2 * half; i++) {
    scene.step(kDt, gravity);
    const Vec3 moved = scene.x(0) - x;
    r.lift = std::fmax(r.lift, std::fabs(moved.z));
    r.aside = std::fmax(r.aside, std::fabs(dot(moved, aside)));
    if (i == half) v = scene.v(0), omega = scene.omega(0);
  }
  r.acceleration = dot(scene.v(0) - v, along) / (half * kDt);
  r.spin_up = dot(scene.omega(0) - omega, aside) / (half * kDt);
  return r;
}

// ---- incline --------------------------------------------------------------------------------

TEST(incline, is_rolled_down_or_slid_down_as_its_slope_says_CPU)
{
  const Real mu = 0.3;
  struct {
    const char *name;
    TriangleSoup soup;
    Vec3 along;
  } floors[] = {
      {"jittered floor", floor_mesh(16, 3, 3), {1, 0, 0}},
      {"along a line of edges and vertices", floor_mesh(12, 3), {1, 0, 0}},
      {"along diagonals through vertices", floor_mesh(12, 3), {std::sqrt(0.5), std::sqrt(0.5), 0}}};
  for (const bool history : {true, false})
    for (const Real degrees : {40., 50.}) {
      const Real a = radians(degrees), c = std::cos(a), s = std::sin(a);
      const bool rolls = std::tan(a) <= 3.5 * mu;
      const Real z = kRadius - kMass * kGravity * c / kStiffness;
      const Real answer = rolls ? 5. / 7 * kGravity * s : kGravity * (s - mu * c);
      const Real spin = rolls ? answer / kRadius : 2.5 * mu * kGravity * c / kRadius;
      Rolled worst = {answer, spin, 0, 0};
      for (const auto &floor : floors) {
        const Rolled r = let_go(floor.soup, law(history, mu), Vec3{0, 0, z} - 1.5 * floor.along,
                                kGravity * s * floor.along - Vec3{0, 0, kGravity * c}, floor.along);
        const auto keep = [](Real right, Real now, Real &kept) {
          if (std::fabs(now - right) >= std::fabs(kept - right)) kept = now;
        };
        keep(answer, r.acceleration, worst.acceleration);
        keep(spin, r.spin_up, worst.spin_up);
        keep(0, r.lift, worst.lift);
        keep(0, r.aside, worst.aside);
      }
      const std::string where =
          std::string("incline of ") + (rolls ? "40 degrees (rolls), " : "50 degrees (slides), ") +
          (history ? "history" : "no history") + ", worst of 3 ways over seams: ";
      const std::string why =
          "6000 steps add up as many roundings of v, 1e-16 each; the overlap rounds by 5e-13 of "
          "itself, and with it the friction";
      expect_answer({"Rolling", "15a", where + "acceleration"}, answer, worst.acceleration,
                    1e-10 * answer, why);
      expect_answer({"Rolling", "15b", where + "angular acceleration"}, spin, worst.spin_up,
                    1e-10 * spin, why);
      expect_at_most({"Rolling", "16a", where + "lift at seams over R"}, worst.lift / kRadius,
                     1e-13,
                     "z = R - mg/k throughout; roundings of 1e-16, which the damped spring "
                     "amplifies no more than 100 times");
      expect_at_most({"Rolling", "16b", where + "drift aside over R"}, worst.aside / kRadius, 1e-13,
                     "none by symmetry; roundings of 1e-16 of the way");
    }
}

// ---- slip to roll ---------------------------------------------------------------------------

TEST(slip, turns_into_rolling_at_its_time_and_place)
{
  const Real mu = 0.3, u0 = 2, dt = 1e-5;
  const Real ts = 2 * u0 / (7 * mu * kGravity), xs = 12 * u0 * u0 / (49 * mu * kGravity);
  for (const bool history : {true, false}) {
    // Without damping along the normal nothing but mu m g acts. The viscous law holds
    // its limit down to a slip of mu g / gamma; the spring lets it go at once.
    const EngineSettings law = history ? hooke_history(kStiffness, kTangent, 0, kGamma, mu)
                                       : hooke(kStiffness, 0, 1e4, mu);
    Scene scene(floor_mesh(16, 2, 3), kRadius, law);
    const Vec3 start = {-1, 0.13, kRadius - kMass * kGravity / kStiffness};
    scene.add_sphere(start, kRadius, kMass, {u0, 0, 0});
    scene.compute(dt, false);
    const auto slip = [&] { return scene.v(0).x - kRadius * scene.omega(0).y; };
    Real t = 0, x = 0;
    while (t < 2 * ts) {
      scene.step(dt, {0, 0, -kGravity});
      t += dt;
      if (x == 0 && slip() <= 1e-3 * u0) {
        const std::string where =
            history ? "slip to roll, history: " : "slip to roll, no history: ";
        x = scene.x(0).x - start.x;
        // The spring stretches by mu m g / kt before it holds.
        const Real late = history ? mu * kMass * kGravity / kTangent : 0;
        const std::string why =
            "a step, the thousandth of the slip that is not waited for, and the "
            "spring's stretch before it holds";
        expect_answer({"Rolling", "13a", where + "time until it rolls, 2 u0 / (7 mu g)"}, ts, t,
                      2 * dt + 1.1e-3 * ts + 2 * late / u0, why);
        expect_answer({"Rolling", "13b", where + "way until it rolls, 12 u0^2 / (49 mu g)"}, xs, x,
                      u0 * (2 * dt + 1.1e-3 * ts) + 2 * late, why);
        expect_at_most({"Rolling", "13d", where + "drift aside over R"},
                       std::fabs(scene.x(0).y - start.y) / kRadius, 1e-13, "none by symmetry");
      }
    }
    expect_answer({"Rolling", "13c",
                   std::string("slip to roll, ") + (history ? "history" : "no history") +
                       ": speed of rolling over u0"},
                  5. / 7, scene.v(0).x / u0, 1e-9,
                  "v + 2/5 R omega is kept to a rounding a step; the slip has faded, as "
                  "exp(-7/4 gamma t) or faster");
  }
}

// ---- groove ----------------------------------------------------------------------------------

// A groove along y of half angle a about the z axis, in n strips a side.
TriangleSoup groove(Real a, int n)
{
  TriangleSoup soup;
  soup.source = "groove";
  const Real s = 3 * std::sin(a), c = 3 * std::cos(a);
  for (const Real x : {-s, s})
    for (int i = 0; i < n; i++) {
      const Real y0 = -3 + 6. * i / n, y1 = -3 + 6. * (i + 1) / n;
      soup.corners.insert(soup.corners.end(), {{0, y0, 0}, {x, y0, c}, {x, y1, c}});
      soup.corners.insert(soup.corners.end(), {{0, y0, 0}, {x, y1, c}, {0, y1, 0}});
    }
  return soup;
}

TEST(groove, is_rolled_along_on_both_its_walls)
{
  // It turns about an axis R sin a above its contacts: a = g sin th / (1 + 2 / (5 sin^2 a)).
  for (const Real degrees : {20., 30., 45., 60., 80.}) {
    const Real a = radians(degrees), tilt = radians(10), n = kMass * kGravity * std::cos(tilt);
    // Up to a right angle two walls bear N/2 sin a each, beyond the rule makes them one.
    const Real at = a <= kPi / 4 ? (kRadius - n / (2 * std::sin(a)) / kStiffness) / std::sin(a)
                                 : kRadius / std::sin(a) - n / kStiffness;
    const Rolled r = let_go(groove(a, 11), law(true, 0.5), {0, -1.3, at},
                            {0, kGravity * std::sin(tilt), -kGravity * std::cos(tilt)}, {0, 1, 0});
    const Real answer = kGravity * std::sin(tilt) / (1 + 0.4 / (std::sin(a) * std::sin(a)));
    char where[64];
    std::snprintf(where, sizeof where, "groove of half angle %g degrees", degrees);
    expect_answer({"Rolling", "03a", std::string(where) + ": acceleration along it"}, answer,
                  r.acceleration, 1e-9 * answer,
                  "walls lean by a rounding, 2e-16, and overlaps round by 2e-12 of themselves");
    expect_at_most(
        {"Rolling", "03b", std::string(where) + ": lift at seams over R"}, r.lift / kRadius,
        1e-12 + 2 * kLessCovered * n / kStiffness / kRadius,
        "height follows from R and sin a, a few roundings, and the damped spring, which swings "
        "about a "
        "height lower by up to 1e-6 of the overlap, as cover is less than the cosine by that");
    expect_at_most({"Rolling", "03c", std::string(where) + ": drift aside over R"},
                   r.aside / kRadius, 1e-12, "none by symmetry");
  }
}

// ---- cone ------------------------------------------------------------------------------------

TEST(cone_tip, is_slid_over_with_one_contact_and_no_loss_CPU)
{
  for (const int n : {10, 50, 200})
    for (const Real aside : {0., 0.003}) {
      const Real slope = 0.05, v = 1;
      Scene scene(cone_mesh(n, 1, slope), kRadius, hooke(kStiffness));
      const Real lean = std::atan(slope);
      // On the side, sunk as deep as it would rest, moving up to the tip.
      const Real sunk = kMass * kGravity * std::cos(lean) / kStiffness, d = kRadius - sunk;
      scene.add_sphere(Vec3{-0.4, aside, -0.4 * slope} +
                           d * Vec3{-std::sin(lean), 0, std::cos(lean)},
                       kRadius, kMass, v * Vec3{std::cos(lean), 0, std::sin(lean)});
      scene.compute(kDt, false, true);
      const auto energy = [&] {
        return 0.5 * kMass * norm_sq(scene.v(0)) + kMass * kGravity * (scene.x(0).z - kRadius + 1) +
               scene.engine->results().totals().energy;
      };
      const Real before = energy();
      Real drift = 0, most = 0, least = 9, held = 0;
      for (int i = 0; scene.x(0).x < 0.4; i++) {
        ASSERT_LT(i, 100000) << "stuck at " << scene.x(0).x;
        scene.step(kDt, {0, 0, -kGravity});
        scene.compute(kDt, false, true);
        const Real contacts = scene.engine->results().n_touching()
                                  ? scene.engine->results().touching()[0].n_contacts
                                  : 0;
        most = std::fmax(most, contacts);
        least = std::fmin(least, contacts);
        held = std::fmax(held, scene.engine->results().totals().energy);
        drift = std::fmax(drift, std::fabs(energy() - before));
      }
      const std::string where =
          std::to_string(n) + " facets, " + (aside > 0 ? "3 mm beside the tip" : "over the tip");
      const Real w = std::sqrt(kStiffness / kMass) * kDt;
      expect_answer({"Rolling", "08a", "cone of " + where + ": most contacts"}, 1, most, 0,
                    "a convex wall has one");
      expect_answer({"Rolling", "08b", "cone of " + where + ": least contacts"}, 1, least, 0,
                    "v^2/R < g: it does not take off");
      expect_at_most(
          {"Rolling", "08c", "cone of " + where + ": energy drift over the elastic energy"},
          drift / held, w * w / 4,
          "velocity Verlet: (dt sqrt(k/m))^2 / 4 of what the spring holds at most");
    }
}

}    // namespace
}    // namespace lsdcd::test_roll
