// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bounces: trains of them, oblique ones that slip or stick, and on a thin plate.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd::test_bounce {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kGravity = 10;

// ---- a train under gravity ------------------------------------------------------------------

// The speed with which a sphere leaves that came with v: y'' = -k/m y - gamma y' + g
// for the overlap y, in closed form, until y = 0.
using Wide = long double;
Wide leaving_speed(Wide v, Wide gamma)
{
  const Wide square = Wide(kStiffness) / kMass, rest = kGravity / square;
  const Wide w = std::sqrt(square - gamma * gamma / 4), b = gamma / 2;
  const auto overlap = [&](Wide t) {
    return rest +
           std::exp(-b * t) * (-rest * std::cos(w * t) + (v - b * rest) / w * std::sin(w * t));
  };
  const auto rate = [&](Wide t) {
    const Wide h = Wide(1e-6) / w;
    return (overlap(t + h) - overlap(t - h)) / (2 * h);
  };
  Wide lo = Wide(0.5) / w, hi = lo;
  while (overlap(hi) > 0) hi += Wide(0.01) / w;
  for (int i = 0; i < 80; i++) (overlap((lo + hi) / 2) > 0 ? lo : hi) = (lo + hi) / 2;
  return -rate(lo);
}

struct Spot {
  const char *name;
  TriangleSoup soup;
  Vec3 at;
};

std::vector<Spot> spots()
{
  const TriangleSoup soup = floor_mesh(4, 2);    // nodes at whole numbers
  return {
      {"a face", soup, {0.3, 0.1, 0}},
      {"an edge", soup, {0.5, 0, 0}},
      {"a vertex", soup, {0, 0, 0}},
      {"a closed plate of 1e-3 R", box_mesh({-2, -2, -1e-3 * kRadius}, {2, 2, 0}), {0.3, 0.1, 0}},
      {"a cone's tip",
       [] {
         TriangleSoup cone;
         cone.source = "cone";
         for (int i = 0; i < 50; i++) {
           const Real a = 2 * kPi * i / 50, b = 2 * kPi * ((i + 1) % 50) / 50;
           cone.corners.insert(
               cone.corners.end(),
               {{0, 0, 0}, {std::cos(a), std::sin(a), -0.5}, {std::cos(b), std::sin(b), -0.5}});
         }
         return cone;
       }(),
       {0, 0, 0}}};
}

TEST(bounce, train_has_the_heights_of_its_restitution)
{
  constexpr Real kGamma = 40, kDrop = 0.2;
  constexpr int kBounces = 4;
  const Real w = std::sqrt(kStiffness / kMass), dt = 0.004 / w;
  std::vector<Real> answer = {kDrop};
  for (int k = 1; k <= kBounces; k++) {
    const Wide v = leaving_speed(std::sqrt(2 * kGravity * Wide(answer[k - 1])), kGamma);
    answer.push_back(Real(v * v / (2 * kGravity)));
  }
  for (const Spot &spot : spots()) {
    Scene scene(spot.soup, kRadius, hooke(kStiffness, kGamma));
    scene.add_sphere(spot.at + Vec3{0, 0, kRadius + kDrop}, kRadius, kMass);
    scene.compute(dt);
    Real off = 0, top = 0, touched = 0, aside = 0;
    for (int k = 0, i = 0; k <= kBounces; i++) {
      ASSERT_LT(i, 1000000) << spot.name << ": bounce " << k << " does not come";
      scene.step(dt, {0, 0, -kGravity});
      const Vec3 moved = scene.x(0) - spot.at;
      aside = std::fmax(aside, std::hypot(moved.x, moved.y));
      if (norm_sq(scene.force(0)) > 0) {
        if (!touched && k > 0) off = std::fmax(off, std::fabs((top - kRadius) / answer[k] - 1));
        if (!touched) k++;
        touched = 1;
        top = 0;
      } else {
        touched = 0;
        top = std::fmax(top, moved.z);
      }
    }
    expect_at_most(
        {"Bouncing", "12",
         std::string("train of 4 bounces on ") + spot.name + ": largest |height / answer - 1|"},
        off, 2 * kBounces * kGamma / w * w * dt + 4e-3 * w * dt,
        "the damping sees the velocity half a step early and ends within a step: "
        "2 gamma dt of the height a bounce, four times");
    expect_at_most({"Bouncing", "12b",
                    std::string("train of 4 bounces on ") + spot.name + ": way to the side over R"},
                   aside / kRadius, 1e-12, "the normal stays upright to a rounding");
  }
}

// ---- oblique -----------------------------------------------------------------------------------

struct Oblique {
  Real v_normal, slip, gained, spin;    // leaving; tangential velocity lost, spin gained
};

// Comes down along -n with speed `v` and along t with `u`; contact law as given.
Oblique oblique(const TriangleSoup &soup, const Vec3 &p, const Vec3 &n, const Vec3 &t,
                const EngineSettings &law, Real v, Real u, Real dt)
{
  Scene scene(soup, kRadius, law);
  // A steep stop: the way along t in the meantime is a few thousandths of R.
  const Real flight = 10.5 * dt;
  scene.add_sphere(p + (kRadius + flight * v) * n - (flight * u) * t, kRadius, kMass,
                   u * t - v * n);
  scene.compute(dt);
  for (const bool touching : {true, false})    // until it touches, until it leaves
    for (int i = 0; (norm_sq(scene.force(0)) > 0) != touching; i++) {
      scene.step(dt, {0, 0, 0});
      if (i > 100000) {
        ADD_FAILURE() << (touching ? "never touches" : "never leaves");
        return {0, 0, 0, 0};
      }
    }
  const Vec3 out = scene.v(0), omega = scene.omega(0);
  const Vec3 surface = out - kRadius * cross(omega, n);
  return {dot(out, n), dot(surface, t), u - dot(out, t), dot(omega, cross(n, t))};
}

TEST(bounce, has_one_restitution_on_faces_edges_and_vertices)
{
  constexpr Real kGamma = 80, kSteps = 4000;
  const Real w = std::sqrt(kStiffness / kMass - kGamma * kGamma / 4), tc = kPi / w;
  const Real e = std::exp(-kGamma * tc / 2);
  const TriangleSoup floor = floor_mesh(4, 2), box = box_mesh({0, 0, 0}, {1, 1, 1});
  struct {
    const char *name;
    const TriangleSoup &soup;
    Vec3 p, n, t;
  } places[] = {{"a face", floor, {0.3, 0.1, 0}, {0, 0, 1}, {1, 0, 0}},
                {"an edge of a plane", floor, {0.5, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                {"a vertex of a plane", floor, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                {"an edge of a cube", box, {1, 0.4, 1}, unit({1, 0, 3}), {0, 1, 0}},
                {"a corner of a cube", box, {1, 1, 1}, unit({2, 1, 3}), unit({1, -2, 0})}};
  for (const auto &place : places) {
    const Oblique o = oblique(place.soup, place.p, place.n, place.t, hooke(kStiffness, kGamma), 0.3,
                              0, tc / kSteps);
    expect_answer({"Bouncing", "11", std::string("restitution on ") + place.name}, e,
                  o.v_normal / 0.3, kPi / kSteps,
                  "exp(-gamma tc / 2), tc = pi / sqrt(k/m - gamma^2/4); the damping sees the "
                  "velocity half a step early: pi / steps. Counted twice it would be e^2 less");
  }
}

// Of a floor.
struct Place {
  const char *name;
  Vec3 p;
};
const Place kPlaces[] = {
    {"a face", {0.3, 0.1, 0}}, {"an edge", {0.5, 0, 0}}, {"a vertex", {0, 0, 0}}};

TEST(oblique, gross_slip_takes_mu_times_the_normal_impulse)
{
  const Real mu = 0.2, v = 0.1, u = 1;
  const Real w = std::sqrt(kStiffness / kMass), dt = kPi / w / 2000;
  for (const bool history : {true, false})
    for (const Place &place : kPlaces) {
      EngineSettings law = history ? hooke_history(kStiffness, 10 * kStiffness, 30, 0, mu)
                                   : hooke(kStiffness, 30, 1e9, mu);
      law.law().limit_damping = true;    // F_n does not pull: its impulse is m (1 + e) v_n
      const Oblique o =
          oblique(floor_mesh(4, 2), place.p, {0, 0, 1}, unit({1, 0.3, 0}), law, v, u, dt);
      const std::string where =
          std::string("gross slip on ") + place.name + (history ? ", history" : ", no history");
      const Real e = o.v_normal / v;
      expect_answer(
          {"Bouncing", "14a", where + ": tangential velocity lost over mu (1 + e) v_n"}, 1,
          o.gained / (mu * (1 + e) * v), 1e-11,
          "|F_t| = mu F_n from the first step on (kt u dt > mu F_n); 2000 roundings of 1e-15");
      expect_answer({"Bouncing", "14b", where + ": spin gained over 5/2 of it by R"}, 1,
                    o.spin / (2.5 * o.gained / kRadius), 1e-12,
                    "force and torque come from one number");
    }
}

TEST(oblique, stick_with_two_sevenths_of_the_stiffness_turns_the_slip_round)
{
  const Real v = 0.1, u = 0.02;
  const Real w = std::sqrt(kStiffness / kMass), dt = kPi / w / 2000;
  for (const Place &place : kPlaces) {
    const Oblique o = oblique(floor_mesh(4, 2), place.p, {0, 0, 1}, unit({1, 0.3, 0}),
                              hooke_history(kStiffness, 2 * kStiffness / 7, 0, 0, 1e9), v, u, dt);
    expect_answer(
        {"Bouncing", "14c",
         std::string("stick with kt = 2/7 kn on ") + place.name + ": slip after over slip before"},
        -1, o.slip / u, 2 * kPi * kPi / 2000 / 2000 * 4,
        "one period for both springs; they begin and end within a step: cos(2 dt w)");
    expect_answer({"Bouncing", "14d",
                   std::string("stick with kt = 2/7 kn on ") + place.name + ": restitution"},
                  1, o.v_normal / v, kPi * kPi / 2000 / 2000, "(dt w)^2 / 4 at each end");
  }
}

}    // namespace
}    // namespace lsdcd::test_bounce
