// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Totals of a wall's meshes over two processes, against what a spring on a floor must give.
#include "support/fake_host.h"
#include "support/meshes.h"
#include "support/test_engine.h"
#include "wall/sums/step_totals.h"

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

WallSpec wall()
{
  WallSpec settings;
  settings.meshes.resize(1);
  return settings;
}

// A floor at z = 0. A step has been computed with spheres at rest that press straight down.
struct Floor {
  const WallSpec settings = wall();
  StepTotals totals;
  std::unique_ptr<WallEngine> engine;
  FlatOf<StepGrid> grid;

  explicit Floor(FakeHost &host) : totals(host, settings)
  {
    EngineSettings of_engine;
    of_engine.law() = classic_law(NormalModel::hooke, false);
    of_engine.law().k_normal = kStiffness;
    of_engine.device = Device::cpu;
    StepGridSettings of_grid;
    of_grid.cutoff = kRadius;
    grid = FlatOf(build_grid(weld(floor_mesh(10, 5, 3), -1), of_grid));
    engine = make_engine(of_engine);
    engine->set_grid(grid.view(), 0);
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

  const MeshTotals &read()
  {
    totals.reduce(&engine->results(), {Pose()});
    return totals.mesh(0);
  }
};

// Spheres over x = 1 and x = 2 press with 10 and 20.
TEST(StepTotals, are_sums_over_the_processes)
{
  on_processes(2, [](FakeHost &host) {
    Floor f(host);
    f.step(1 + host.rank(), 0.1 * (1 + host.rank()));
    const MeshTotals &t = f.read();
    expect_near(t.force, {0, 0, -30});
    expect_near(t.torque_at_origin, {-30, 10 * 1 + 20 * 2, 0});
    EXPECT_EQ(t.contacts, 2);
    EXPECT_NEAR(t.energy, 50 * (0.01 + 0.04), kRounding);
  });
}


TEST(StepTotals, are_those_of_the_last_step_until_a_step_has_been_computed)
{
  FakeHost host;
  Floor f(host);
  f.step(0, 0.1);
  expect_near(f.read().force, {0, 0, -10});
  f.step(0, 0.2);
  expect_near(f.read().force, {0, 0, -20});
  f.totals.clear();
  expect_near(f.read().force, {0, 0, 0});
}


}    // namespace
}    // namespace lsdcd::test_step_totals
