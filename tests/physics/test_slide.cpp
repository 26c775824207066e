// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Springs: carried over seams, edges, corners and folds, below and above the friction limit.
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace lsdcd::test_slide {
namespace {

constexpr Real kStiffness = 1e5, kTangent = 3e4, kRadius = 0.5, kMass = 2, kOverlap = 0.01;
constexpr Real kAt = kRadius - kOverlap, kDt = 1e-3;

// A place on a path: centre, direction of travel (unit) and the wall's normal there.
struct Place {
  Vec3 x, along, normal;
};
using Path = std::function<Place(Real)>;    // by the way travelled

struct Slid {
  Real jump;         // largest |h_i - h_(i-1) - v dt| / |h_i|, where one contact stays one
  Real off;          // largest |F_t + kt s along| / (kt s)
  Real off_whole;    // the same over kt times the whole way
  Real limit;        // largest | |F_t| / (mu F_n) - 1 |, after the first tenth
  Real contacts;     // most
};

// Moves a sphere along a path without turning it: its spring is as long as the way. `scale`: of the spring's stiffness, at this
// overlap.
Slid slide(const TriangleSoup &soup, const Path &path, Real length, int n,
           const EngineSettings &law, Real scale = 1)
{
  Scene scene(soup, kRadius, law);
  const Real ds = length / n, v = ds / kDt;
  scene.add_sphere(path(0).x, kRadius, kMass);
  Slid out = {0, 0, 0, 0, 0};
  Real last = 0;
  for (int i = 1; i <= n; i++) {
    const Real s = i * ds;
    const Place p = path(s);
    scene.set_x(0, p.x);
    scene.set_v(0, v * p.along);
    scene.compute(kDt, true, true);
    const Vec3 f = scene.force(0), t = f - dot(f, p.normal) * p.normal;
    const Real off = norm(t + scale * kTangent * s * p.along) / (scale * kTangent);
    out.off = std::fmax(out.off, off / s);
    out.off_whole = std::fmax(out.off_whole, off / length);
    const Real normal = dot(f, p.normal);
    if (i > n / 10)
      out.limit = std::fmax(out.limit, std::fabs(norm(t) / (law.law().mu * normal) - 1));
    if (scene.engine->results().n_touching() != 1) {
      ADD_FAILURE() << "no contact at " << s;
      break;
    }
    out.contacts = std::fmax(out.contacts, scene.engine->results().touching()[0].n_contacts);
    if (scene.springs.count(0) == 1) {
      const Real h = norm(scene.springs.spring(0, 0).shear);
      out.jump = std::fmax(out.jump, std::fabs(h - last - ds) / h);
      last = h;
    }
  }
  return out;
}

Path straight(const Vec3 &from, const Vec3 &along)
{
  const Vec3 u = (1 / norm(along)) * along;
  return [=](Real s) { return Place{from + s * u, u, {0, 0, 1}}; };
}

// Over the top of the box [0,4]^3, then round what is at `rim` (on its edge or
// corner), in the upright plane of the level unit vector `out`, then down. The
// axis of the round is level; `askew` (0..1) is the share of motion along it.
Path over_rim(const Vec3 &rim, const Vec3 &out, Real before, Real askew)
{
  const Vec3 axis = cross(Vec3{0, 0, 1}, out);
  const Real across = std::sqrt(1 - askew * askew), arc = kAt * kPi / 2;
  return [=](Real s) {
    const Real p = s * across - before;    // the way across, 0 where the arc begins
    const Vec3 sideways = (s * askew) * axis;
    Vec3 x, u, n;
    if (p < 0) {
      n = {0, 0, 1};
      u = out;
      x = rim + kAt * n + p * out;
    } else if (p < arc) {
      const Real a = p / kAt;
      n = std::cos(a) * Vec3{0, 0, 1} + std::sin(a) * out;
      u = std::cos(a) * out - std::sin(a) * Vec3{0, 0, 1};
      x = rim + kAt * n;
    } else {
      n = out;
      u = {0, 0, -1};
      x = rim + kAt * n + (p - arc) * u;
    }
    return Place{x + sideways, across * u + askew * axis, n};
  };
}

struct Course {
  const char *id, *name;
  TriangleSoup soup;
  Path path;
  Real length;
};

std::vector<Course> courses()
{
  const Vec3 diagonal = {std::sqrt(0.5), std::sqrt(0.5), 0};
  const TriangleSoup box = box_mesh({0, 0, 0}, {4, 4, 4});
  return {
      {"17a", "across the seams of a jittered floor", floor_mesh(40, 2, 5),
       straight({-1.4, -0.9, kAt}, {0.9, 0.63, 0}), 3},
      {"17b", "along a line of edges and vertices", floor_mesh(8, 2),
       straight({-1.4, 0, kAt}, {1, 0, 0}), 2.8},
      {"17c", "along diagonals, vertex to vertex", floor_mesh(8, 2),
       straight({-1.4, -1.4, kAt}, {1, 1, 0}), 3.9},
      {"17d", "over the edge of a cube", box, over_rim({4, 1, 4}, {1, 0, 0}, 1, 0), 2.5},
      {"17e", "askew over the edge of a cube", box, over_rim({4, 1, 4}, {1, 0, 0}, 1, 0.4), 2.5},
      {"17f", "over the corner of a cube", box, over_rim({4, 4, 4}, diagonal, 1, 0), 2.5}};
}

const char *kSum =
    "the stretch is a sum of up to 5000 steps, one rounding each, and is turned with "
    "the normal";

EngineSettings history(Real mu)
{
  return hooke_history(kStiffness, kTangent, 0, 0, mu);
}

TEST(slide, below_the_limit_stretches_the_spring_by_the_way)
{
  for (const Course &c : courses()) {
    const Slid s = slide(c.soup, c.path, c.length, 5000, history(1e6));
    expect_at_most(
        {"History", c.id,
         std::string(c.name) + ", below the limit: largest jump of the spring, of its length"},
        s.jump, 1e-10, "as asked; " + std::string(kSum));
    expect_at_most(
        {"History", c.id, std::string(c.name) + ", below the limit: |F_t - kt s| over kt s"}, s.off,
        1e-10, kSum);
    EXPECT_EQ(s.contacts, 1);
    const Slid hertz =
        slide(c.soup, c.path, c.length, 5000, hertz_history(kStiffness, kTangent, 0, 0, 1e6),
              std::sqrt(kOverlap * kRadius));
    EXPECT_LE(hertz.jump, 1e-10) << c.name;
    EXPECT_LE(hertz.off, 1e-10) << c.name;
  }
}

TEST(slide, above_the_limit_drags_with_mu_times_the_normal_force)
{
  for (const Course &c : courses()) {
    const Slid s = slide(c.soup, c.path, c.length, 5000, history(0.3));
    expect_at_most(
        {"History", c.id, std::string(c.name) + ", above the limit: |F_t / (mu F_n) - 1|"}, s.limit,
        1e-11, "overlaps round by 1e-14 of themselves, coordinates of 4 by 1e-15 of 0.01");
  }
}

TEST(slide, back_from_the_limit_begins_with_a_spring_that_is_cut_to_it)
{
  // Forth 1 m over seams, slipping, then back: from mu F_n at once with slope kt to the
  // other limit, and there it stays.
  const Real mu = 0.3, limit = mu * kStiffness * kOverlap, ds = 1e-4;
  Scene scene(floor_mesh(40, 2, 5), kRadius, history(mu));
  const Vec3 u = {0.8, 0.6, 0}, from = {-1.4, -0.9, kAt};
  scene.add_sphere(from, kRadius, kMass);
  Real off = 0;
  for (int i = 1; i <= 20000; i++) {
    const bool forth = i <= 10000;
    scene.set_x(0, from + ds * (forth ? i : 20000 - i) * u);
    scene.set_v(0, (forth ? ds : -ds) / kDt * u);
    scene.compute(kDt);
    const Real answer = forth ? std::fmin(limit, kTangent * i * ds)
                              : std::fmax(-limit, limit - kTangent * (i - 10000) * ds);
    off = std::fmax(off, std::fabs(dot(scene.force(0), u) + answer) / limit);
  }
  expect_at_most({"History", "17j", "forth and back across seams: |F_t - answer| over mu F_n"}, off,
                 1e-10,
                 "at the limit the spring is mu F_n / kt long; 100 steps of one rounding to "
                 "the other limit, each 3e-14 of it");
}

// ---- the corner of two walls ---------------------------------------------------------

TEST(slide, into_the_corner_of_two_walls_and_along_it_keeps_two_springs)
{
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, history(1e6));
  const int n = 1000;
  const Real ds = 1e-3, v = ds / kDt;
  const Vec3 start = {kAt + n * ds, 1, kAt};
  scene.add_sphere(start, kRadius, kMass, {-v, 0, 0});
  Real off = 0;
  for (int i = 1; i <= n; i++) {    // to the wall x = 0, on the floor
    scene.set_x(0, {start.x - i * ds, 1, kAt});
    scene.compute(kDt);
  }
  scene.set_v(0, {0, v, 0});
  for (int i = 1; i <= n; i++) {    // along both
    scene.set_x(0, {kAt, 1 + i * ds, kAt});
    scene.compute(kDt);
    const Vec3 f = scene.force(0);
    // The floor's spring holds the way to the wall too; the wall's began in the corner.
    const Vec3 answer = {kStiffness * kOverlap + kTangent * n * ds, -2 * kTangent * i * ds,
                         kStiffness * kOverlap};
    off = std::fmax(off, norm(f - answer) / norm(answer));
  }
  expect_at_most(
      {"History", "17g", "into the corner of two walls and along it: |F - F_two springs| over F"},
      off, 1e-10, kSum);
  EXPECT_EQ(scene.springs.count(0), 2);
}

TEST(slide, into_the_corner_of_two_walls_above_the_limit_drags_on_both)
{
  const Real mu = 0.4;
  Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), kRadius, history(mu));
  const Real ds = 1e-3, v = ds / kDt;
  scene.add_sphere({kAt, 1, kAt}, kRadius, kMass, {0, v, 0});
  Real off = 0;
  for (int i = 1; i <= 2000; i++) {
    scene.set_x(0, {kAt, 1 + i * ds, kAt});
    scene.compute(kDt);
    if (i > 100)
      off = std::fmax(off, std::fabs(scene.force(0).y / (-2 * mu * kStiffness * kOverlap) - 1));
  }
  expect_at_most(
      {"History", "17h", "along the corner of two walls, above the limit: |F_t / (2 mu F_n) - 1|"},
      off, 1e-11, "overlaps round by 1e-14 of themselves");
}

// ---- a drum ---------------------------------------------------------------------------------------

TEST(slide, round_a_drum_is_continuous)
{
  for (const int n : {64, 256, 1024}) {
    constexpr Real kDrum = 5;
    // The way of the centre, a quarter round, at the depth that a segment's middle has.
    const Real turn = 2 * kPi / n, rho = kDrum * std::cos(turn / 2) - kAt;
    const Path path = [=](Real s) {
      const Real a = 0.3 + s / rho;
      return Place{{rho * std::cos(a), rho * std::sin(a), 1},
                   {-std::sin(a), std::cos(a), 0},
                   {-std::cos(a), -std::sin(a), 0}};
    };
    const Real length = rho * kPi / 2;
    const TriangleSoup drum = cylinder_mesh(n, 1, kDrum, 2);
    const std::string name = "a quarter round a drum of " + std::to_string(n) + " segments";
    const Slid below = slide(drum, path, length, 20000, history(1e6));
    expect_at_most(
        {"History", "17i", name + ", below the limit: |F_t - kt s| over kt times the way"},
        below.off_whole,
        turn * turn / 2 * n / 4 + turn * kStiffness * kOverlap / (kTangent * length),
        "each of n/4 seams hands on cos(turn) of the spring; the normal force leans by "
        "the angle of a segment");
  }
}

TEST(slide, spring_acts_but_does_not_move_where_a_run_is_set_up)
{
  Scene scene(floor_mesh(40, 2, 5), kRadius, history(1e6));
  scene.add_sphere({0.1, 0.2, kAt}, kRadius, kMass, {1, 0.5, 0}, {0, 3, 1});
  for (int i = 0; i < 20; i++) scene.compute(kDt);
  const Vec3 force = scene.force(0), torque = scene.torque(0);
  Real off = 0;
  for (int i = 0; i < 3; i++) {
    scene.compute(kDt, false);
    off = std::fmax(off, norm(scene.force(0) - force) + norm(scene.torque(0) - torque));
  }
  expect_answer({"History", "21a", "forces evaluated again where a run is set up: |difference|"}, 0,
                off, 0, "without damping nothing but the spring counts: the same bits");
}

// ---- a break in mid-slide -------------------------------------------------------------------------

TEST(slide, broken_off_and_taken_up_again_is_the_same_to_the_last_bit)
{
  // Sliding and rolling down two walls of a box at once, springs packed as in a restart
  // file (and as between processes) half way; without update at the new start.
  const EngineSettings law = hooke_history(kStiffness, kTangent, 60, 30, 0.3);
  const TriangleSoup box = box_mesh({0, 0, 0}, {4, 4, 4});
  const Vec3 gravity = {-5, 1, -10};
  const Real dt = 1e-4;
  const auto begin = [&](Scene &scene) {
    scene.add_sphere({kRadius - 1e-4, 1, kRadius - 2e-4}, kRadius, kMass, {0, 1, 0}, {3, 0, 1});
    scene.compute(dt, false);
    for (int i = 0; i < 2000; i++) scene.step(dt, gravity);
  };
  Scene whole(box, kRadius, law), first(box, kRadius, law), second(box, kRadius, law);
  begin(whole);
  begin(first);
  std::vector<double> packed(first.springs.packed_size(0));
  first.springs.pack(0, packed.data());
  ASSERT_EQ(first.springs.count(0), 2);
  second.add_sphere(first.x(0), kRadius, kMass, first.v(0), first.omega(0));
  second.springs.unpack(0, packed.data());
  // As LAMMPS does where a run begins, in both: forces once more, springs at rest.
  whole.compute(dt, false);
  second.compute(dt, false);
  for (int i = 0; i < 2000; i++) {
    whole.step(dt, gravity);
    second.step(dt, gravity);
  }
  Real off = norm(whole.x(0) - second.x(0)) + norm(whole.v(0) - second.v(0)) +
             norm(whole.omega(0) - second.omega(0));
  ASSERT_EQ(whole.springs.count(0), second.springs.count(0));
  for (int k = 0; k < whole.springs.count(0); k++)
    off += norm(whole.springs.spring(0, k).shear - second.springs.spring(0, k).shear);
  expect_answer({"History", "21",
                 "broken off on two walls in mid-slide and taken up again: |difference| "
                 "in place, speed, spin and springs"},
                0, off, 0, "the springs are packed whole: the same bits");
}

}    // namespace
}    // namespace lsdcd::test_slide
