// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall of two processes, threads here, through the library's headers: against one process.
#include "floor_and_grains.h"
#include "process.h"
#include "support/fake_host.h"

#include <cmath>
#include <string>
#include <vector>

namespace test_library_processes {
namespace {

class processes : public FloorTest {};

// Grains that slide and settle: explicit, the same sums in the same order on any process.
void move(Grains &g)
{
  for (std::size_t i = 0; i < g.x.size(); i++) {
    g.v[i] += kDt * (g.force[i] / g.mass[i / 3] - (i % 3 == 2 ? 9.81 : 0));
    g.omega[i] += kDt * g.torque[i] / (0.4 * g.mass[i / 3] * 0.25);
    g.x[i] += kDt * g.v[i];
  }
}

TEST_F(processes, give_a_sphere_that_changes_process_the_trajectory_of_one_process)
{
  constexpr int kBefore = 40, kAfter = 60;
  lsdcd::Wall alone = floor_wall();
  Grains all;
  all.add(-1, 0, 0.49, 0.5);
  all.add(1, 0.3, 0.48, -0.2);
  for (int k = 0; k < kBefore + kAfter; k++) {
    all.step(alone);
    move(all);
  }

  // Process 0 has both at first; the second one then goes to process 1, which had none.
  std::vector<double> packed, body;
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall = floor_wall("", &process.options);
    Grains mine;
    if (host.rank() == 0) {
      mine.add(-1, 0, 0.49, 0.5);
      mine.add(1, 0.3, 0.48, -0.2);
    }
    for (int k = 0; k < kBefore; k++) {
      mine.step(wall);
      move(mine);
    }
    if (host.rank() == 0) {
      packed = wall.pack({1});
      for (const auto *a : {&mine.x, &mine.v, &mine.omega})
        body.insert(body.end(), a->begin() + 3, a->end());
      for (auto *a : {&mine.x, &mine.v, &mine.omega, &mine.force, &mine.torque}) a->resize(3);
      mine.radius.resize(1);
      mine.mass.resize(1);
      wall.renumber({0});
    }
    double arrived = host.rank() == 0;
    host.max(&arrived, 1);
    if (host.rank() == 1) {
      mine.add(0, 0, 0);
      std::copy_n(body.begin(), 3, mine.x.begin());
      std::copy_n(body.begin() + 3, 3, mine.v.begin());
      std::copy_n(body.begin() + 6, 3, mine.omega.begin());
      wall.renumber({-1});
      wall.unpack({0}, packed);
    }
    for (int k = 0; k < kAfter; k++) {
      mine.step(wall);
      move(mine);
    }
    const std::size_t at = 3 * host.rank();
    for (int k = 0; k < 3; k++) {
      EXPECT_EQ(mine.x[k], all.x[at + k]);
      EXPECT_EQ(mine.omega[k], all.omega[at + k]);
    }
  });
}

TEST_F(processes, feed_a_servo_with_the_forces_of_all)
{
  const std::string pushes = "servo force z 25 vmax 0.5";
  lsdcd::Wall alone = floor_wall(pushes);
  Grains all;
  all.add(3, -3, 0.49);
  all.add(-3, 3, 0.495);
  all.step(alone, 50);
  const lsdcd_wall_totals one = alone.totals(0);    // here, as a wall serves one thread at a time
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall = floor_wall(pushes, &process.options);
    Grains mine;
    if (host.rank() == 0)
      mine.add(3, -3, 0.49);
    else
      mine.add(-3, 3, 0.495);
    mine.step(wall, 50);
    // A sum of two numbers, in either order: the same bits.
    const lsdcd_wall_totals both = wall.totals(0);
    EXPECT_EQ(both.servo_position, one.servo_position);
    EXPECT_NE(one.servo_position, 0);
    EXPECT_EQ(both.force[2], one.force[2]);
    EXPECT_EQ(both.contacts, 2);
  });
}

// One that is outside of the box on the second process is told by the first.
TEST_F(processes, are_warned_once_of_spheres_outside_of_the_box)
{
  std::vector<std::string> warnings;
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    Process process(host);
    set_box(process.options, 5, false);
    process.options.data = &warnings;
    process.options.show = [](void *data, int warning, const char *text) {
      if (warning) static_cast<std::vector<std::string> *>(data)->push_back(text);
    };
    lsdcd::Wall wall = floor_wall("", &process.options);
    Grains mine(1, 1, 0.49);
    mine.add(host.rank() == 0 ? 2 : 6, 2, 0.49);
    mine.step(wall, 3);
  });
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(begins(warnings[0], "1 sphere is outside of the box, where the wall may not reach: "
                                  "the first, x[1] of process 1, is at 6 2 0.49"));
}

TEST_F(processes, go_on_from_what_each_saved)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall first = floor_wall("", &process.options), second = floor_wall("", &process.options);
    Grains mine(host.rank(), 0, 0.49, 0.1 + host.rank());
    mine.step(first, 10);
    Grains same = mine;
    second.restore(first.save());
    mine.step(first, 3);
    same.step(second, 3);
    EXPECT_EQ(same.force, mine.force);
    EXPECT_NE(mine.force[0], 0);
  });
}

TEST_F(processes, refuse_together_what_one_has_not_saved)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall first = floor_wall("", &process.options), second = floor_wall("", &process.options);
    Grains mine(host.rank(), 0, 0.49, 0.1);
    mine.step(first, 2);
    std::vector<double> saved = first.save();
    if (host.rank() == 1) saved.pop_back();
    EXPECT_TRUE(begins(text_of([&] { second.restore(saved); }),
                       "these are not the numbers that lsdcd_wall_save() wrote"));
    second.restore(first.save());
  });
}

TEST_F(processes, show_each_line_once)
{
  std::vector<std::string> shown[2];
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    Process process(host);
    process.options.data = shown;
    process.options.show = [](void *data, int warning, const char *text) {
      static_cast<std::vector<std::string> *>(data)[warning].push_back(text);
    };
    lsdcd::Wall wall = floor_wall("", &process.options);
    Grains mine;
    if (host.rank() == 1) mine.add(0, 0, 0.3);    // deep in the wall
    mine.step(wall, 1, true);
  });
  EXPECT_EQ(shown[0].size(), 2u);    // the wall, and its grid
  EXPECT_EQ(shown[1].size(), 1u);
}

TEST_F(processes, are_all_told_of_a_sphere_of_one_in_the_next_call)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    Process process(host);
    for (int k = 0; k < 3; k++) process.options.hi[k] = -(process.options.lo[k] = -20);
    process.options.periodic[0] = 1;    // each step asks all how far spheres went past its faces
    process.options.margin = 0.1;
    lsdcd::Wall wall = floor_wall("", &process.options);
    Grains mine;
    mine.add(0, 0, 0.49);
    mine.add(2, 0, 0.49);
    mine.step(wall);
    if (host.rank() == 1) mine.radius[1] = 0.51;    // without `changed`
    mine.step(wall);
    const std::string told = text_of([&] { wall.totals(); });
    EXPECT_TRUE(begins(told, "sphere 1 (from 0) of process 1 "));
    EXPECT_EQ(text_of([&] { mine.step(wall); }), told);
  });
}

TEST_F(processes, refuse_together_what_one_gives_wrongly)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    lsdcd::Wall wall = floor_wall("", &process.options);
    Grains mine(0, 0, 0.49);
    lsdcd_spheres s = mine.spheres();
    if (host.rank() == 1) s.torque = nullptr;
    lsdcd_wall_step step = step_of();
    EXPECT_EQ(text_of([&] { wall.step(s, step); }), "`torque` is null");
    s.torque = mine.torque.data();
    step.dt = kDt * (1 + host.rank());
    EXPECT_EQ(text_of([&] { wall.step(s, step); }),
              "dt goes from 0.001 to 0.002 over the processes: dt, setup and synchronous are the "
              "same on all");
    step.dt = kDt;
    step.synchronous = host.rank();
    EXPECT_EQ(text_of([&] { wall.step(s, step); }),
              "dt goes from 0.001 to 0.001 over the processes, and some are synchronous: dt, setup "
              "and synchronous are the same on all");
  });
}

TEST_F(processes, refuse_together_nodes_that_differ)
{
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &host) {
    const Process process(host);
    for (const bool differ : {false, true})
      for (const bool in_place : {true, false}) {
        lsdcd::Wall wall = floor_wall("nodes caller", &process.options);
        Grains mine(host.rank(), 0.25, 0.49);
        std::vector<double> x = wall.nodes(0), v(x.size(), 0);
        (in_place ? x : v)[4] += differ && host.rank() == 1 ? 0.125 : 0.25;
        wall.set_nodes(0, x, v);
        EXPECT_EQ(has(text_of([&] { mine.step(wall); }),
                      "nodes given by lsdcd_wall_set_nodes() or inputs by lsdcd_wall_set_input() "
                      "do: call it on all"),
                  differ)
            << in_place;
      }
  });
}

TEST_F(processes, are_told_of_a_callback_that_fails)
{
  lsdcd::FakeHost host;
  Process process(host);
  process.callbacks.max = [](void *, double *, int) { return 5; };
  EXPECT_EQ(text_of([&] { floor_wall("", &process.options); }),
            "`lsdcd_host`: max() returned 5, not 0: end all processes");
}

TEST_F(processes, refuse_numbers_that_were_not_packed)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  grains.add(0, 0, 0.49, 0.1);
  grains.add(2, 0, 0.49, 0.2);
  grains.step(wall, 3);
  const std::vector<double> packed = wall.pack({0, 1});
  const auto refused = [&](std::vector<double> numbers) {
    return code_of([&] { wall.unpack({0, 1}, numbers); }) == LSDCD_ERROR_ARGUMENT;
  };
  for (std::size_t n = 0; n < packed.size(); n++)
    EXPECT_TRUE(refused({packed.begin(), packed.begin() + n})) << n;
  for (const std::size_t k : {0, 2, 3}) {    // kind, contacts, mesh and feature of the first
    std::vector<double> other = packed;
    other[k] = 1e15;
    EXPECT_TRUE(refused(other)) << k;
    other[k] = NAN;
    EXPECT_TRUE(refused(other)) << k;
  }
  EXPECT_EQ(code_of([&] { wall.pack({2}); }), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(code_of([&] { wall.unpack({0, 2}, packed); }), LSDCD_ERROR_ARGUMENT);
  EXPECT_EQ(code_of([&] { wall.unpack({1, 0}, packed); }), LSDCD_OK);
  std::swap(grains.v[0], grains.v[3]);
  std::swap(grains.x[0], grains.x[3]);
  grains.step(wall);
  EXPECT_NEAR(grains.force[0], -kT * 4 * 0.2 * kDt, kT * kRounding);
}

// One of two spheres of a name would lose its springs.
TEST_F(processes, refuse_a_sphere_that_would_be_there_twice)
{
  lsdcd::Wall wall = floor_wall();
  Grains grains;
  for (const double x : {0, 2, 4}) grains.add(x, 0, 0.49, 0.1);
  grains.step(wall, 3);
  const std::vector<double> one = wall.pack({0}), two = wall.pack({0, 1}), same = wall.pack({0, 0});
  const auto says = [&](const std::vector<std::ptrdiff_t> &to, const std::vector<double> &numbers) {
    return text_of([&] { wall.unpack(to, numbers); });
  };
  EXPECT_TRUE(has(says({2, 2}, two), "to[1] is 2, as one before it: give each sphere once"));
  EXPECT_TRUE(has(says({1, 2}, same), "to[1] is 2, and gets what to[0] gets"));
  EXPECT_TRUE(has(says({2}, one), "to[0] gets what was packed of sphere 0, which is still there"));
  wall.renumber({1, 2, -1});
  EXPECT_EQ(says({2}, one), "");
}

}    // namespace
}    // namespace test_library_processes
