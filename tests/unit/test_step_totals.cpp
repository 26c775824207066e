// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Totals of a wall's meshes over two processes, against what a spring on a floor must give.
#include "support/fake_host.h"
#include "support/meshes.h"
#include "support/test_engine.h"
#include "wall/step_totals.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace lsdcd::test_step_totals {
namespace {

constexpr Real kStiffness = 100, kRadius = 0.5;
// Sums of a few numbers below 200: a dozen roundings of 200 x 2^-53 at most.
constexpr Real kRounding = 3e-13;

void expect_near(const Vec3 &found, const Vec3 &expected)
{
  for (int k = 0; k < 3; k++) EXPECT_NEAR(found[k], expected[k], kRounding) << "xyz"[k];
}

// A floor at z = 0, twice where the wall has two meshes: the second one 50 to the right. A step has been
// computed with spheres at rest that press straight down.
class Floors {
 public:
  Floors(FakeHost &host, const WallSpec &settings) : totals(host, settings)
  {
    EngineSettings of_engine;
    of_engine.law() = classic_law(NormalModel::hooke, false);
    of_engine.law().k_normal = kStiffness;
    of_engine.meshes = static_cast<int>(settings.meshes.size());
    of_engine.moves = true;
    of_engine.device = Device::cpu;
    GridSettings of_grid;
    of_grid.cutoff = kRadius;
    grid_ = FlatGrid(build_grid(weld(floor_mesh(10, 5, 3), -1), of_grid));
    engine = make_engine(of_engine);
    poses.resize(of_engine.meshes);
    for (int k = 0; k < of_engine.meshes; k++) {
      engine->set_grid(grid_.view(), k);
      poses[k].placed = true;
      poses[k].shift = {50. * k, 0, 0};
      engine->set_pose(poses[k], k);
    }
  }

  // A sphere whose overlap is this, over the point (x, 1, 0).
  void step(Real x, Real overlap)
  {
    SphereArrays one;
    one.add({x, 1, kRadius - overlap}, kRadius);
    const Spheres s = one.spheres();
    StepSettings step;
    step.dt = 1e-3;
    engine->choose(s, 0);
    engine->step(s, step);
    totals.expire();
  }

  const MeshTotals &of(int mesh)
  {
    totals.reduce(&engine->results(), poses);
    return totals.mesh(mesh);
  }

  StepTotals totals;
  std::unique_ptr<WallEngine> engine;
  std::vector<Pose> poses;

 private:
  FlatGrid grid_;
};

WallSpec wall(int n_meshes)
{
  WallSpec settings;
  settings.meshes.resize(n_meshes);
  return settings;
}

// Spheres over x = 1 and x = 2 press with 10 and 20.
TEST(StepTotals, are_sums_over_the_processes)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall(1);
    Floors f(host, settings);
    f.step(1 + host.rank(), 0.1 * (1 + host.rank()));
    const MeshTotals &t = f.of(0);
    expect_near(t.force, {0, 0, -30});
    expect_near(t.torque_at_origin, {-30, 10 * 1 + 20 * 2, 0});
    EXPECT_EQ(t.contacts, 2);
    EXPECT_NEAR(t.energy, 50 * (0.01 + 0.04), kRounding);
  });
}

TEST(StepTotals, have_the_torque_about_a_point_of_the_box)
{
  FakeHost host;
  WallSpec settings = wall(1);
  settings.meshes[0].torque_about = {1, 1, 7};
  Floors f(host, settings);
  f.step(3, 0.1);    // 10 down, 2 to the right of the point
  expect_near(f.of(0).torque, {0, 2 * 10, 0});
}

TEST(StepTotals, have_the_torque_about_a_point_that_moves_with_the_mesh)
{
  FakeHost host;
  WallSpec settings = wall(1);
  settings.meshes[0].torque_about_mesh = true;
  settings.meshes[0].torque_about = {1, 1, 7};
  Floors f(host, settings);
  f.step(3, 0.1);
  f.poses[0].shift = {0.5, 0, 0};    // the point has come 0.5 nearer
  expect_near(f.of(0).torque, {0, 1.5 * 10, 0});
}

TEST(StepTotals, have_the_power_of_a_mesh_that_lifts_and_tilts)
{
  FakeHost host;
  const WallSpec settings = wall(1);
  Floors f(host, settings);
  f.step(3, 0.1);
  f.poses[0].velocity = {0, 0, 2};
  f.poses[0].angular = {0, -4, 0};    // which lifts the floor at x = 3 with a speed of 12
  EXPECT_NEAR(f.of(0).power, 10 * (2 + 12), kRounding);
}

TEST(StepTotals, are_those_of_the_last_step_until_a_step_has_been_computed)
{
  FakeHost host;
  const WallSpec settings = wall(1);
  Floors f(host, settings);
  f.step(0, 0.1);
  expect_near(f.of(0).force, {0, 0, -10});
  f.step(0, 0.2);
  expect_near(f.of(0).force, {0, 0, -20});
  f.totals.clear();
  expect_near(f.of(0).force, {0, 0, 0});
}

// The spheres of both processes are over x = 1 of the first mesh, and of the second one.
TEST(StepTotals, of_all_meshes_are_sums_and_the_largest_overlap)
{
  on_processes(2, [](FakeHost &host) {
    const WallSpec settings = wall(2);
    Floors f(host, settings);
    f.step(1 + 50 * host.rank(), 0.1 * (1 + host.rank()));
    expect_near(f.of(0).force, {0, 0, -10});
    expect_near(f.of(1).force, {0, 0, -20});
    const MeshTotals all = f.totals.of_all();
    expect_near(all.force, {0, 0, -30});
    EXPECT_NEAR(all.overlap, 0.2 / kRadius, kRounding);
    EXPECT_EQ(all.contacts, 2);
  });
}

// About different points the torques of two meshes have no sum but that about the origin.
TEST(StepTotals, of_meshes_with_torques_about_different_points_are_about_the_origin)
{
  FakeHost host;
  WallSpec settings = wall(2);
  settings.meshes[1].torque_about = {51, 1, 0};
  Floors f(host, settings);
  f.step(51, 0.1);
  expect_near(f.of(1).torque, {0, 0, 0});
  // Numbers of 510.
  EXPECT_NEAR(f.totals.of_all().torque.y, 510, 3 * kRounding);
}

}    // namespace
}    // namespace lsdcd::test_step_totals
