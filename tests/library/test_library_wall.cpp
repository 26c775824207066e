// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall through the library's headers: forces in closed form, springs that follow their spheres, wrong use.
#include "floor_and_grains.h"
#include "support/random.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <string>
#include <vector>

namespace test_library_wall {
namespace {

class wall : public FloorTest {};

TEST_F(wall, moves_springs_in_steps_only)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains(0.3, 0.2, 0.49, 0.1);
  grains.step(wall, 1, true);
  EXPECT_EQ(grains.force[0], 0);
  grains.step(wall, 10);
  EXPECT_NEAR(grains.force[0], -kT * 10 * 0.1 * kDt, kT * kRounding);
}

TEST_F(wall, lets_springs_follow_spheres_that_change_their_numbers)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  grains.add(1, 0, 0.49, 0.1);
  grains.add(-1, 0, 0.49, 0.3);
  grains.step(wall, 10);
  Grains other;
  other.add(5, 5, 0.49, 0);    // a new one
  other.add(-1, 0, 0.49, 0.3);
  wall.renumber({-1, 1});
  other.step(wall);
  EXPECT_EQ(other.force[0], 0);
  EXPECT_NEAR(other.force[3], -kT * 11 * 0.3 * kDt, kT * kRounding);
}

TEST_F(wall, has_the_contacts_and_totals_of_its_last_step_after_a_change_of_motion)
{
  for (const bool asks : {false, true}) {
    lsdcd::Wall wall = floor_wall("each_contact");
    Grains grains(0.3, 0.2, 0.49, 0.1);
    grains.step(wall, 1);
    if (asks) wall.totals(0);
    wall.change("motion linear 0 0 0.1");
    const auto contacts = wall.contacts();
    ASSERT_EQ(contacts.size(), 1u) << asks;
    EXPECT_NEAR(contacts[0].force[2], 0.01 * kN, kN * kRounding);
    EXPECT_NEAR(wall.totals(0).force[2], -0.01 * kN, kN * kRounding);
    EXPECT_EQ(wall.totals(0).contacts, 1);
  }
}

TEST_F(wall, goes_on_from_what_was_saved)
{
  const std::string moves = "motion linear 0.01 0 0";
  lsdcd::Wall first = floor_wall(moves), second = floor_wall(moves);
  Grains grains(0.3, 0.2, 0.49, 0.1);
  grains.step(first, 10);
  Grains same = grains;
  second.restore(first.save());
  grains.step(first, 3);
  same.step(second, 3);
  EXPECT_EQ(same.force, grains.force);
}

TEST_F(wall, has_totals_of_a_mesh_that_moves)
{
  lsdcd::Wall wall = floor_wall("motion linear 0 0 2");
  Grains grains(3, 0, 0.49);
  grains.step(wall);
  const lsdcd_wall_totals totals = wall.totals(0);
  const double force = kN * (0.01 + 2 * kDt);
  EXPECT_NEAR(totals.force[2], -force, kN * kRounding);
  EXPECT_NEAR(totals.torque[1], 3 * force, 3 * kN * kRounding);    // about the origin
  EXPECT_NEAR(totals.power, 2 * force, 2 * kN * kRounding);        // on the sphere
  EXPECT_EQ(totals.contacts, 1);
  EXPECT_EQ(wall.pose()[11], 2 * kDt);
}

// A turn about an axis along y through (1, 0, 0), once in 2.
TEST_F(wall, has_the_pose_of_a_mesh_that_turns)
{
  lsdcd::Wall wall = floor_wall("motion rotate 1 0 0 0 1 0 2");
  Grains grains(0, 0, 5);
  grains.step(wall, 100);
  const double angle = std::acos(-1.) * 100 * kDt, c = std::cos(angle), s = std::sin(angle);
  const std::array<double, 12> wanted = {c, 0, s, 1 - c, 0, 1, 0, 0, -s, 0, c, s};
  const std::array<double, 12> pose = wall.pose();
  // Time is a sum of 100 steps, each rounded.
  for (int k = 0; k < 12; k++) EXPECT_NEAR(pose[k], wanted[k], 100 * kRounding) << k;
}

// They stay, go a little and leap, from where no list of the wall has them.
TEST_F(wall, feels_spheres_wherever_they_go)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  for (int i = 0; i < 50; i++) grains.add(0, 0, 5);
  lsdcd::Random random(3);
  double pushed = 0;
  for (int step = 0; step < 200; step++) {
    grains.step(wall);
    for (std::size_t k = 0; k < grains.x.size(); k += 3) {
      double *at = &grains.x[k];
      const double wanted = at[2] < 0.5 ? kN * (0.5 - at[2]) : 0;
      ASSERT_NEAR(grains.force[k + 2], wanted, kN * kRounding) << step;
      pushed += wanted > 0;
      const double size = std::pow(10., lsdcd::uniform(random, -6, 1));
      for (int d = 0; d < 2; d++) at[d] = std::fmod(at[d] + lsdcd::uniform(random, -size, size), 9);
      at[2] = 0.3 + std::fabs(std::fmod(at[2] - 0.3 + lsdcd::uniform(random, -size, size), 5));
    }
  }
  EXPECT_GT(pushed, 500);
}

TEST_F(wall, without_a_box_is_felt_all_over_a_mesh_of_2000_radii)
{
  const double half = 500;
  const std::vector<double> floor = {-half, -half, 0, half,  -half, 0,
                                     half,  half,  0, -half, half,  0};
  const api::Mesh large(floor, {0, 1, 2, 0, 2, 3});
  for (const bool moves : {false, true}) {
    SCOPED_TRACE(moves);
    lsdcd::Wall wall(kFloorWords + (moves ? "motion linear 1 0 0" : ""), {{"floor", large}});
    Grains grains;
    for (double x = 1 - half; x < half; x += 2) grains.add(x, x / 2, 0.4);
    grains.step(wall, 1, true);
    for (std::size_t k = 0; k < grains.x.size(); k += 3)
      ASSERT_NEAR(grains.force[k + 2], kN * 0.1, kN * kRounding) << grains.x[k];
  }
}

TEST_F(wall, shows_its_log_and_warnings)
{
  Shown shown;
  lsdcd::Wall wall = floor_wall("", &shown);
  ASSERT_EQ(shown.lines.size(), 1u);
  EXPECT_TRUE(has(shown.lines[0], "floor"));
  EXPECT_TRUE(has(shown.lines[0], "contact     hooke/history, kn 1000, kt 300"));
  Grains grains(0, 0, 0.3);    // deep in the wall
  grains.step(wall, 1, true);
  EXPECT_EQ(shown.warnings.size(), 1u);
}

TEST_F(wall, acts_through_a_periodic_face_and_warns_past_it)
{
  Shown shown;
  set_box(shown, 20);
  lsdcd::Wall wall = floor_wall("move 0 0 -19.6", &shown);
  Grains grains(0, 0, 19.92);    // the image of the floor is at z = 20.4
  grains.step(wall);
  EXPECT_NEAR(grains.force[2], -kN * 0.02, kN * 1e-13);
  EXPECT_TRUE(shown.warnings.empty());
  grains.x[2] = 20.3;
  grains.step(wall);
  ASSERT_EQ(shown.warnings.size(), 1u);
  EXPECT_TRUE(begins(shown.warnings[0], "a grain was 0.3 past a periodic face"));
}

TEST_F(wall, refuses_numbers_that_it_did_not_save)
{
  lsdcd::Wall wall = floor_wall(), other = floor_wall();
  Grains grains(0, 0, 0.49, 0.1);
  grains.step(wall);
  std::vector<double> saved = wall.save();
  while (!saved.empty()) {
    saved.pop_back();
    EXPECT_EQ(code_of([&] { other.restore(saved); }), LSDCD_ERROR_ARGUMENT) << saved.size();
  }
  saved = wall.save();
  saved.push_back(0);
  EXPECT_EQ(code_of([&] { other.restore(saved); }), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(code_of([&] { other.restore({3, 1, 2, 3}); }), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(code_of([&] { other.restore({4, -6, 1e6, 0, 1e9, 0}); }), LSDCD_ERROR_ARGUMENT);
}

TEST_F(wall, needs_a_GPU_for_arrays_on_one)
{
  if (lsdcd_has_cuda()) GTEST_SKIP() << "there is one";
  lsdcd::WallOptions options;
  options.device = LSDCD_CUDA;
  const std::string told = text_of([&] { floor_wall("", &options); }),
                    remedy = "; use LSDCD_CPU, with arrays of the host";
  EXPECT_TRUE(begins(told, "CUDA: "));
  EXPECT_EQ(told.substr(told.size() - remedy.size()), remedy);
  EXPECT_EQ(code_of([&] { floor_wall("", &options); }), LSDCD_ERROR_DEVICE);
}

// In a process of its own: a driver stays.
TEST_F(wall, refuses_arrays_that_only_a_GPU_can_read)
{
  if (dlopen("libcuda.so.1", RTLD_NOLOAD | RTLD_LAZY)) GTEST_SKIP() << "a driver is loaded";
  const auto step_with_a_driver = [&] {
    lsdcd::Wall wall = floor_wall();
    Grains grains(0, 0, 0.49);
    if (!dlopen(LSDCD_FAKE_CUDA, RTLD_NOW)) std::_Exit(-1);
    std::_Exit(code_of([&] { grains.step(wall); }) + 100 * (grains.force[2] != 0));
  };
  EXPECT_EXIT(step_with_a_driver(), testing::ExitedWithCode(LSDCD_ERROR_DEVICE), "");
}

// Places in each step, the other numbers where spheres are looked at.
TEST_F(wall, refuses_spheres_without_a_place_a_velocity_a_size_or_a_mass)
{
  const double nan = std::nan(""), inf = HUGE_VAL;
  const struct {
    std::function<void(Grains &)> spoil;
    const char *text;    // empty: it is taken
    bool in_each_step = false;
  } rows[] = {
      {[=](Grains &g) { g.x[3] = nan; }, "x[1] is nan 0 0.49, which is not finite", true},
      {[=](Grains &g) { g.x[5] = inf; }, "x[1] is 1 0 inf", true},
      {[=](Grains &g) { g.v[5] = -inf; }, "v[1] is 0 0 -inf, which is not finite"},
      {[=](Grains &g) { g.omega[7] = inf; }, "omega[2] is 0 inf 0, which is not finite"},
      {[=](Grains &g) { g.radius[2] = nan; }, "radius[2] is nan"},
      {[=](Grains &g) { g.radius[2] = inf; }, "radius[2] is inf"},
      {[](Grains &g) { g.radius[2] = -0.1; }, "radius[2] is -0.1"},
      {[](Grains &g) { g.radius[2] = 0; }, ""},
      {[=](Grains &g) { g.mass[0] = nan; }, "mass[0] is nan"},
      {[=](Grains &g) { g.mass[0] = inf; }, "mass[0] is inf"},
      {[](Grains &g) { g.mass[0] = -1; }, "mass[0] is -1"},
      {[](Grains &g) { g.mass[0] = 0; }, "mass[0] is 0"},
  };
  for (const auto &row : rows)
    for (const int steps : {0, 2}) {
      if (steps > 0 && !row.in_each_step) continue;
      lsdcd::Wall wall = floor_wall();
      Grains grains;
      for (int i = 0; i < 3; i++) grains.add(i, 0, 0.49);
      grains.step(wall, steps);
      const Grains right = grains;
      row.spoil(grains);
      const std::string told = text_of([&] { grains.step(wall); });
      EXPECT_TRUE(begins(told, row.text));
      EXPECT_EQ(told.empty(), !*row.text) << told;
      grains = right;
      grains.step(wall);
    }
}

// Along z the box repeats, and nothing is outside.
TEST_F(wall, warns_once_of_spheres_outside_of_its_box)
{
  Shown shown;
  set_box(shown, 5);
  lsdcd::Wall wall = floor_wall("", &shown);
  Grains grains(5, 5, 0.49);
  grains.add(-5, 0, 0.49);
  grains.add(0, 0, 5.05);
  grains.step(wall, 2);
  EXPECT_EQ(shown.warnings.size(), 0u);
  grains.x[4] = 5.5;
  grains.x[0] = 6;
  grains.step(wall, 2);
  ASSERT_EQ(shown.warnings.size(), 1u);
  EXPECT_TRUE(begins(shown.warnings[0], "2 spheres are outside of the box, where the wall may not "
                                        "reach: the first, x[0], is at 6 5 0.49"));
}

// Without a box nothing is outside, so that the second call has nothing to show.
TEST_F(wall, tells_what_its_show_has_thrown_after_a_whole_step)
{
  lsdcd::WallOptions options;
  options.show = [](void *, int warning, const char *) {
    if (warning) throw std::runtime_error("no more lines");
  };
  set_box(options, 5, false);
  lsdcd::Wall wall = floor_wall("", &options), quiet = floor_wall();
  Grains grains, same;
  for (Grains *g : {&grains, &same}) {
    g->add(0, 0, 0.49);
    g->add(6, 0, 3);
  }
  EXPECT_EQ(code_of([&] { grains.step(wall); }), LSDCD_ERROR_CANCELLED);
  EXPECT_EQ(std::string(lsdcd_last_error()), "`show` has thrown: no more lines");
  same.step(quiet);
  EXPECT_EQ(grains.force, same.force);
  grains.step(wall);
  same.step(quiet);
  EXPECT_EQ(grains.force, same.force);
}

TEST_F(wall, is_not_made_where_its_show_throws)
{
  lsdcd::WallOptions options;
  options.show = [](void *, int, const char *) { throw 1; };
  EXPECT_EQ(text_of([&] { floor_wall("", &options); }), "`show` has thrown: not a std::exception");
}

TEST_F(wall, takes_vectors_that_lie_between_each_other_and_refuses_those_that_overlap)
{
  lsdcd::Wall wall = floor_wall();
  constexpr int kRow = 16,
                kSpheres = 3;    // x, v, omega, force and torque are 3 numbers each, one is free
  std::vector<double> all(kSpheres * kRow), ones(kSpheres, 1), radii(kSpheres, 0.5);
  for (int i = 0; i < kSpheres; i++) all[i * kRow + 2] = 0.49;
  lsdcd_spheres s = {};
  s.size = sizeof s;
  s.n = kSpheres;
  s.row = kRow;
  s.x = all.data();
  s.v = s.x + 3;
  s.omega = s.x + 6;
  s.force = all.data() + 9;
  s.torque = all.data() + 12;
  s.radius = radii.data();
  s.mass = ones.data();
  lsdcd_wall_step step = step_of();
  wall.step(s, step);
  for (int i = 0; i < kSpheres; i++) EXPECT_GT(all[i * kRow + 11], 0) << i;
  const auto says = [&] { return text_of([&] { wall.step(s, step); }); };
  s.torque = all.data() + kRow + 10;    // of the next row
  EXPECT_EQ(says(), "`force` and `torque` share memory: give each an array of its own");
  s.torque = all.data() + 12;
  s.mass = all.data() + 12;    // numbers side by side, of which some are torques
  EXPECT_EQ(says(), "`torque` and `mass` share memory: give each an array of its own");
  s.mass = ones.data();
  EXPECT_EQ(says(), "");
  // Forces in an array of their own, and torques that begin in what is free of its last row, or one row before.
  std::vector<double> others(2 * kSpheres * kRow);
  s.force = others.data();
  s.torque = others.data() + (kSpheres - 1) * kRow + 15;
  EXPECT_EQ(says(), "");
  EXPECT_GT(others[2 * kRow + 2], 0);
  s.torque -= kRow;
  EXPECT_EQ(says(), "`force` and `torque` share memory: give each an array of its own");
  s.force = others.data() + (kSpheres - 1) * kRow + 15;
  s.torque = others.data();
  EXPECT_EQ(says(), "");
}

TEST_F(wall, names_a_sphere_by_its_place_in_the_arrays_after_they_were_sorted)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  grains.add(5, 5, 0.49);
  grains.add(0, 0, 0.49);
  grains.add(-5, 0, 0.49);
  grains.step(wall);
  wall.renumber({2, 0, 1});
  grains.step(wall);
  grains.radius[2] = 0.51;
  EXPECT_TRUE(begins(text_of([&] { grains.step(wall); }), "sphere 2 (from 0) has radius 0.51"));
}

// A sphere that outgrew its grid is found when the springs of the step have moved.
TEST_F(wall, refuses_all_calls_after_a_step_that_failed_half_way)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  grains.add(5, 5, 0.49);
  grains.add(0, 0, 0.49);
  grains.step(wall);
  grains.radius[1] = 0.51;
  const std::string first = text_of([&] { grains.step(wall); });
  grains.radius[1] = 0.5;
  const std::function<void()> calls[] = {
      [&] { grains.step(wall); },         [&] { wall.totals(); },  [&] { wall.save(); },
      [&] { wall.renumber({1, 0}); },     [&] { wall.pack({0}); }, [&] { wall.pose(0); },
      [&] { wall.change("motion none"); }};
  for (const std::function<void()> &call : calls) {
    EXPECT_EQ(code_of(call), LSDCD_ERROR_INPUT);
    EXPECT_TRUE(
        begins(text_of(call), "a step of this wall failed half-way, so it cannot go on: " + first));
  }
}

// What the rows below call, each spoilt in one thing.
struct Calls {
  lsdcd_wall *wall;
  lsdcd_value floor = {};
  Grains grains;
  lsdcd_spheres spheres;
  lsdcd_wall_step step = {};
  lsdcd_wall_totals totals = {};
  lsdcd_wall_contacts contacts = {};
  lsdcd_body_state body = {};
  lsdcd_wall_options options = {};
  lsdcd_host host = {};
  double numbers[12] = {};
  std::ptrdiff_t which[2] = {0, 1};
  std::size_t count = 0;

  Calls(lsdcd_wall *wall, const api::Mesh &mesh) : wall(wall)
  {
    floor.name = "floor";
    floor.kind = LSDCD_VALUE_MESH;
    floor.mesh = mesh.get();
    grains.add(0, 0, 0.49);
    grains.add(1, 0, 0.49);
    spheres = grains.spheres();
    step.size = sizeof step;
    step.dt = kDt;
    totals.size = sizeof totals;
    contacts.size = sizeof contacts;
    body.size = sizeof body;
    options.size = sizeof options;
    host.size = sizeof host;
    host.processes = 1;
    host.sum = host.max = [](void *, double *, int) { return 0; };
    host.broadcast = [](void *, void *, size_t, int) { return 0; };
  }
  int take_step() const { return lsdcd_wall_step_spheres(wall, &spheres, &step); }
  int change(const char *by) const { return lsdcd_wall_change(wall, by, nullptr, 0); }
  int make() { return make_by(kFloorWords.c_str()); }
  int make_by(const char *words)
  {
    lsdcd_wall *made = nullptr;
    const int code = lsdcd_wall_create(words, &floor, 1, &options, &made);
    lsdcd_wall_free(made);
    return code;
  }
  int make_with(const std::string &more) { return make_by((kFloorWords + more).c_str()); }
  int make_for(void (*spoil)(lsdcd_host &))
  {
    spoil(host);
    options.host = &host;
    return make();
  }
};

TEST_F(wall, says_what_is_wrong_with_a_call)
{
  const double nan = std::nan(""), inf = HUGE_VAL;
  using C = Calls;
  const struct {
    std::function<int(C &)> call;
    const char *text;
  } rows[] = {
      // Steps.
      {[](C &c) { return lsdcd_wall_step_spheres(nullptr, &c.spheres, &c.step); },
       "`wall` is null"},
      {[](C &c) { return lsdcd_wall_step_spheres(c.wall, nullptr, &c.step); },
       "`lsdcd_spheres` is null"},
      {[](C &c) { return lsdcd_wall_step_spheres(c.wall, &c.spheres, nullptr); },
       "`lsdcd_wall_step` is null"},
      {[](C &c) { return c.spheres.size = 0, c.take_step(); },
       "`lsdcd_spheres`: size is 0, and should be"},
      {[](C &c) { return c.step.size++, c.take_step(); },
       "`lsdcd_wall_step`: size is 41, and should be"},
      {[](C &c) { return c.spheres.x = nullptr, c.take_step(); }, "`x` is null"},
      {[](C &c) { return c.spheres.v = nullptr, c.take_step(); }, "`v` is null"},
      {[](C &c) { return c.spheres.omega = nullptr, c.take_step(); }, "`omega` is null"},
      {[](C &c) { return c.spheres.radius = nullptr, c.take_step(); }, "`radius` is null"},
      {[](C &c) { return c.spheres.mass = nullptr, c.take_step(); }, "`mass` is null"},
      {[](C &c) { return c.spheres.force = nullptr, c.take_step(); }, "`force` is null"},
      {[](C &c) { return c.spheres.torque = nullptr, c.take_step(); }, "`torque` is null"},
      {[](C &c) { return c.spheres.torque = c.spheres.force, c.take_step(); },
       "`force` and `torque` share memory"},
      {[](C &c) { return c.spheres.row = 1, c.take_step(); },
       "row is 1: vectors of 3 numbers need 3 or more, 0 is 3"},
      {[](C &c) { return c.spheres.n = 1, c.take_step(); }, "n is 1, and it was 2"},
      {[](C &c) { return c.spheres.n = std::size_t(1) << 31, c.take_step(); },
       "n is 2147483648, more than"},
      {[](C &c) { return c.step.dt = 0, c.take_step(); }, "dt is 0, not above 0"},
      {[=](C &c) { return c.step.dt = inf, c.take_step(); }, "dt is inf, not above 0"},
      {[=](C &c) { return c.step.reach = nan, c.take_step(); }, "reach is nan, below 0"},
      {[](C &c) { return c.step.setup = 2, c.take_step(); }, "`setup` is 2: it is 0 or 1"},
      {[](C &c) { return c.step.changed = -1, c.take_step(); }, "`changed` is -1: it is 0 or 1"},
      {[](C &c) { return c.step.synchronous = 3, c.take_step(); },
       "`synchronous` is 3: it is 0 or 1"},
      // Answers.
      {[](C &c) { return lsdcd_wall_get_totals(nullptr, 0, nullptr, &c.totals); },
       "`wall` is null"},
      {[](C &c) { return lsdcd_wall_get_totals(c.wall, 0, nullptr, nullptr); },
       "`lsdcd_wall_totals` is null"},
      {[](C &c) { return c.totals.size = 1, lsdcd_wall_get_totals(c.wall, 0, nullptr, &c.totals); },
       "`lsdcd_wall_totals`: size is 1"},
      {[](C &c) { return lsdcd_wall_get_totals(c.wall, 1, nullptr, &c.totals); },
       "mesh is 1; this wall has 1"},
      {[=](C &c) {
         return c.numbers[1] = nan, lsdcd_wall_get_totals(c.wall, 0, c.numbers, &c.totals);
       },
       "`about[1]` is nan: give a finite"},
      {[](C &c) { return lsdcd_wall_get_pose(c.wall, 0, nullptr); }, "`matrix` is null"},
      {[](C &c) { return lsdcd_wall_get_pose(c.wall, -1, c.numbers); },
       "mesh is -1; this wall has 1"},
      {[](C &c) { return lsdcd_wall_get_contacts(c.wall, nullptr); },
       "`lsdcd_wall_contacts` is null"},
      {[](C &c) { return c.contacts.size = 0, lsdcd_wall_get_contacts(c.wall, &c.contacts); },
       "`lsdcd_wall_contacts`: size is 0"},
      {[](C &c) { return lsdcd_wall_get_contacts(c.wall, &c.contacts); },
       "this wall does not keep its contacts: say each_contact when the wall is made"},
      {[](C &c) { return lsdcd_wall_get_body(c.wall, 0, nullptr); }, "`lsdcd_body_state` is null"},
      {[](C &c) { return lsdcd_wall_get_body(c.wall, 0, &c.body); },
       "mesh 0, 'floor', is not a body"},
      {[](C &c) { return lsdcd_wall_get_nodes(c.wall, 0, c.numbers); },
       "mesh 0, 'floor', has no nodes"},
      {[](C &c) { return lsdcd_wall_get_node_forces(c.wall, 0, c.numbers); },
       "mesh 0, 'floor', has no nodes"},
      {[](C &c) { return lsdcd_wall_get_node_count(c.wall, 0, &c.count); },
       "mesh 0, 'floor', has no nodes"},
      {[](C &c) { return lsdcd_wall_get_node_count(c.wall, 0, nullptr); }, "`count` is null"},
      // What moves a mesh.
      {[](C &c) { return lsdcd_wall_set_pose(c.wall, 0, c.numbers, nullptr, nullptr, nullptr); },
       "mesh 0, 'floor', is not posed by the caller"},
      {[](C &c) { return lsdcd_wall_set_nodes(c.wall, 0, c.numbers, nullptr); },
       "mesh 0, 'floor', has no nodes"},
      {[](C &c) { return c.change(nullptr); }, "`words` is null"},
      {[](C &c) { return c.change(""); }, "nothing is given to change: write [mesh NAME] motion"},
      {[](C &c) { return lsdcd_wall_change(c.wall, "motion none", nullptr, 1); },
       "`values` is null"},
      {[](C &c) { return c.change("motion slide 0 0 1"); },
       "in 'motion', 'slide' is not one of its values"},
      {[](C &c) { return c.change("servo force axis 0 0 0 1 vmax 1"); },
       "in 'servo', the axis ax ay az must not be 0 0 0"},
      {[](C &c) { return c.change("body motor 1"); },
       "the mesh is not a body, and cannot become one later"},
      {[](C &c) { return lsdcd_wall_set_input(c.wall, nullptr, 1); }, "`name` is null"},
      // Spheres that go, and saved states.
      {[](C &c) { return lsdcd_wall_renumber(c.wall, nullptr, 2); }, "`from` is null"},
      {[](C &c) { return c.which[1] = 2, lsdcd_wall_renumber(c.wall, c.which, 2); },
       "from[1] is 2: each is a"},
      {[](C &c) { return c.which[1] = 0, lsdcd_wall_renumber(c.wall, c.which, 2); },
       "from[1] is 0: each is a"},
      {[](C &c) { return c.which[0] = -2, lsdcd_wall_renumber(c.wall, c.which, 2); },
       "from[0] is -2: each is a"},
      {[](C &c) { return lsdcd_wall_pack(c.wall, c.which, 2, nullptr, 0, nullptr); },
       "`count` is null"},
      {[](C &c) { return lsdcd_wall_pack(c.wall, nullptr, 2, nullptr, 0, &c.count); },
       "`which` is null"},
      {[](C &c) { return lsdcd_wall_pack(c.wall, c.which, 2, nullptr, 9, &c.count); },
       "`numbers` is null"},
      {[](C &c) {
         return c.which[1] = 5, lsdcd_wall_pack(c.wall, c.which, 2, nullptr, 0, &c.count);
       },
       "which[1] is 5"},
      {[](C &c) { return lsdcd_wall_unpack(c.wall, c.which, 2, nullptr, 0); }, "`numbers` is null"},
      {[](C &c) { return lsdcd_wall_unpack(c.wall, nullptr, 2, c.numbers, 12); }, "`to` is null"},
      {[](C &c) { return lsdcd_wall_unpack(c.wall, c.which, 2, c.numbers, 12); },
       "these are not the numbers that lsdcd_wall_pack() wrote"},
      {[](C &c) { return lsdcd_wall_save(c.wall, nullptr, 0, nullptr); }, "`count` is null"},
      {[](C &c) { return lsdcd_wall_save(c.wall, nullptr, 5, &c.count); }, "`numbers` is null"},
      {[](C &c) { return lsdcd_wall_restore(c.wall, nullptr, 5); }, "`numbers` is null"},
      {[](C &c) { return lsdcd_wall_restore(c.wall, c.numbers, 5); },
       "a wall is restored before its first step"},
      {[](C &c) {
         const std::ptrdiff_t same[] = {0, 1};
         lsdcd_wall_renumber(c.wall, same, 2);
         return lsdcd_wall_restore(c.wall, c.numbers, 5);
       },
       "a wall is restored before its first step"},
      // Walls.
      {[](C &c) { return lsdcd_wall_create(kFloorWords.c_str(), &c.floor, 1, nullptr, nullptr); },
       "`wall` is null"},
      {[](C &c) { return c.make_by(nullptr); }, "`words` is null"},
      {[](C &c) { return lsdcd_wall_create(kFloorWords.c_str(), nullptr, 1, nullptr, &c.wall); },
       "`values` is null"},
      {[](C &c) { return c.floor.name = nullptr, c.make(); },
       "`values[0].name` is null: give a name, without $"},
      {[](C &c) { return c.floor.kind = 9, c.make(); },
       "`values[0].kind` is 9: it is LSDCD_VALUE_NUMBERS"},
      {[](C &c) { return c.floor.mesh = nullptr, c.make(); },
       "`values[0].mesh` is null: give a mesh"},
      {[](C &c) { return c.make_with("scale 0 1 1"); }, "in 'scale', the factor must not be zero"},
      {[](C &c) { return c.make_with("rotate 0 0 0 90"); },
       "in 'rotate', the axis must not be 0 0 0"},
      {[](C &c) { return c.make_with("move nan 0 0"); },
       "in 'move', x must be a number, not 'nan'"},
      {[](C &c) { return c.options.size = 8, c.make(); },
       "`lsdcd_wall_options`: size is 8, and should be"},
      {[](C &c) { return c.options.threads = -1, c.make(); }, "`threads` is -1; it is 0 to 4096"},
      {[](C &c) { return c.options.device = 2, c.make(); },
       "`lsdcd_wall_options`: device is neither"},
      {[](C &c) { return c.options.stream = &c, c.make(); },
       "`lsdcd_wall_options`: stream is given"},
      {[](C &c) { return c.options.lo[0] = 1, c.make(); },
       "`lsdcd_wall_options`: lo must be below hi"},
      {[](C &c) { return c.options.periodic[1] = 1, c.make(); },
       "`lsdcd_wall_options`: lo must be below hi"},
      {[](C &c) { return c.options.periodic[1] = 2, c.make(); },
       "`lsdcd_wall_options.periodic[1]` is 2: it is 0 or 1"},
      {[=](C &c) { return c.options.time = nan, c.make(); },
       "`lsdcd_wall_options`: margin is 0, time nan"},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.size = 0; }); },
       "`lsdcd_host`: size is 0"},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.rank = 1; }); },
       "`lsdcd_host`: rank is 1"},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.processes = 0; }); }, "`lsdcd_host`: "},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.node_rank = -1; }); }, "`lsdcd_host`: "},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.sum = nullptr; }); },
       "`lsdcd_host`: `sum` is null: give all three, or no host for one process"},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.max = nullptr; }); },
       "`lsdcd_host`: `max` is null"},
      {[](C &c) { return c.make_for([](lsdcd_host &h) { h.broadcast = nullptr; }); },
       "`lsdcd_host`: `broadcast` is null"},
      // Sub-models.
      {[](C &) { return lsdcd_sub_model_get_facts(0, nullptr); },
       "`lsdcd_sub_model_facts` is null"},
  };
  lsdcd::Wall wall = floor_wall();
  Calls(wall.get(), *mesh_).take_step();
  const std::vector<double> before = wall.save();
  for (const auto &row : rows) {
    Calls calls(wall.get(), *mesh_);
    EXPECT_EQ(row.call(calls), LSDCD_ERROR_ARGUMENT) << row.text;
    EXPECT_TRUE(begins(lsdcd_last_error(), row.text));
    for (const double f : calls.grains.force) EXPECT_EQ(f, 0) << row.text;
  }
  EXPECT_EQ(wall.save(), before);    // none has changed anything
}

TEST_F(wall, goes_on_after_a_step_that_was_refused_before_it_began)
{
  lsdcd::Wall wall = floor_wall(), unbroken = floor_wall();
  Grains grains(0, 0, 0.49, 0.1);
  Grains same = grains;
  grains.step(wall, 3);
  same.step(unbroken, 3);
  grains.mass[0] = 0;
  lsdcd_wall_step wrong = {};
  wrong.size = sizeof wrong;
  EXPECT_EQ(code_of([&] { wall.step(grains.spheres(), wrong); }), LSDCD_ERROR_ARGUMENT);
  wrong.dt = kDt;
  wrong.changed = 1;
  EXPECT_EQ(code_of([&] { wall.step(grains.spheres(), wrong); }), LSDCD_ERROR_ARGUMENT);
  grains.mass = same.mass;
  grains.step(wall);
  same.step(unbroken);
  EXPECT_EQ(grains.force, same.force);
}

}    // namespace
}    // namespace test_library_wall
