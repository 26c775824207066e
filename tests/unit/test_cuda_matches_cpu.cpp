// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The CUDA engine against the CPU engine: one source, so the same bits.
#include "effects/effects.h"
#include "support/crowd.h"

#include <gtest/gtest.h>

using namespace lsdcd;

namespace {

Outcome run_on(Device device, const Case &c, const ContactLaw &law,
               const Search &search = kComplete, const EngineSettings &wall = {})
{
  const auto make = [device](EngineSettings e) {
    e.device = device;
    return make_engine(e);
  };
  return run_steps(c, law, make, 20000, search, wall);
}

GridSettings grid_settings(const Case &c)
{
  GridSettings g;
  g.within = within(c);
  g.cutoff = c.cutoff;
  g.length = c.length;
  return g;
}

const ContactLaw kStyles[] = {classic(NormalModel::hooke, false), classic(NormalModel::hooke, true),
                              classic(NormalModel::hertz, true)};

TEST(cuda_grid, has_the_same_lists_as_the_cpu_grid)
{
  for (const Case &c : cases()) {
    const WeldedMesh mesh = mesh_of(c);
    const GridSettings g = grid_settings(c);
    const TriangleGrid cpu = build_grid(mesh, g, false), cuda = build_grid(mesh, g, true);
    EXPECT_TRUE(same_bytes(cpu.lists.brick_of, cuda.lists.brick_of)) << c.name;
    EXPECT_TRUE(same_bytes(cpu.lists.bricks, cuda.lists.bricks)) << c.name;
    EXPECT_TRUE(same_bytes(cpu.lists.cells, cuda.lists.cells)) << c.name;
    EXPECT_TRUE(same_bytes(cpu.lists.candidates, cuda.lists.candidates)) << c.name;
    EXPECT_GT(cuda.lists.candidates.size() + cuda.lists.cells.size(), 0u) << c.name;
  }
}

TEST(cuda_grid, has_the_same_nearest_lists_and_float_records_as_the_cpu_grid)
{
  for (const Case &c : cases()) {
    const WeldedMesh mesh = mesh_of(c);
    GridSettings g = grid_settings(c);
    g.list_kind = ListKind::of_option(3);
    g.in_floats = true;
    const TriangleGrid cpu = build_grid(mesh, g, false), cuda = build_grid(mesh, g, true);
    std::vector<char> a(flat_bytes(cpu)), b(flat_bytes(cuda));
    flatten(cpu, a.data());
    flatten(cuda, b.data());
    EXPECT_TRUE(same_bytes(a, b)) << c.name;
    EXPECT_GT(cuda.records.faces.size(), 0u) << c.name;
  }
}

TEST(cuda_engine, gives_the_forces_of_the_cpu_engine)
{
  // Same source, no contraction, IEEE division and root on both: no tolerance.
  for (const Case &c : cases())
    for (const ContactLaw &law : kStyles) {
      const Outcome cpu = run_on(Device::cpu, c, law);
      const Outcome cuda = run_on(Device::cuda, c, law);
      EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.torque, cuda.torque)) << c.name;
      EXPECT_GT(cpu.totals.contacts, 0) << c.name;
    }
}

TEST(cuda_engine, gives_the_forces_of_the_cpu_engine_however_it_searches)
{
  for (const Search &search : other_searches())
    for (const Case &c : cases()) {
      const Outcome cpu = run_on(Device::cpu, c, classic(NormalModel::hertz, true), search);
      const Outcome cuda = run_on(Device::cuda, c, classic(NormalModel::hertz, true), search);
      EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << c.name << ", " << search.name;
      EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << c.name << ", " << search.name;
      EXPECT_EQ(cpu.totals.uncertified, cuda.totals.uncertified) << c.name << ", " << search.name;
      EXPECT_GT(cpu.totals.contacts, 0) << c.name << ", " << search.name;
    }
}

TEST(cuda_engine, gives_the_springs_of_the_cpu_engine)
{
  for (const Case &c : cases()) {
    const Outcome cpu = run_on(Device::cpu, c, classic(NormalModel::hertz, true));
    const Outcome cuda = run_on(Device::cuda, c, classic(NormalModel::hertz, true));
    EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << c.name;
    EXPECT_GT(cpu.springs.size(), 0u) << c.name;
  }
}

TEST(cuda_engine, gives_the_totals_and_outputs_of_the_cpu_engine)
{
  for (const Case &c : cases()) {
    const Outcome cpu = run_on(Device::cpu, c, classic(NormalModel::hooke, true));
    const Outcome cuda = run_on(Device::cuda, c, classic(NormalModel::hooke, true));
    EXPECT_EQ(cpu.totals.contacts, cuda.totals.contacts) << c.name;
    EXPECT_EQ(cpu.totals.energy, cuda.totals.energy) << c.name;
    EXPECT_TRUE(cpu.totals.force == cuda.totals.force) << c.name;
    EXPECT_TRUE(cpu.totals.torque == cuda.totals.torque) << c.name;
    EXPECT_TRUE(same_bytes(cpu.outputs, cuda.outputs)) << c.name;
  }
}

TEST(cuda_engine, gives_what_granular_laws_give_on_the_cpu)
{
  for (const Case &c : cases())
    for (NormalModel normal :
         {NormalModel::hooke, NormalModel::hertz, NormalModel::dmt, NormalModel::jkr}) {
      const Outcome cpu = run_on(Device::cpu, c, everything(normal));
      const Outcome cuda = run_on(Device::cuda, c, everything(normal));
      EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.torque, cuda.torque)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.extra, cuda.extra)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.heat, cuda.heat)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.outputs, cuda.outputs)) << c.name;
      EXPECT_GT(cpu.extra.size(), 0u) << c.name;
    }
}

TEST(cuda_engine, gives_what_every_effect_gives_on_the_cpu)
{
  const std::vector<Case> walls = cases();
  for (const EffectCase &effect : effect_cases()) {
    const Case &c = walls[effect.name.size() % walls.size()];
    const EngineSettings &s = effect.settings;
    const Outcome cpu = run_on(Device::cpu, c, s.law(), kComplete, s);
    const Outcome cuda = run_on(Device::cuda, c, s.law(), kComplete, s);
    EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.torque, cuda.torque)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.extra, cuda.extra)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.records, cuda.records)) << effect.name << ", " << c.name;
    EXPECT_EQ(cpu.records.empty(), !s.records && !s.bodies) << effect.name << ", " << c.name;
  }
}

TEST(cuda_engine, gives_the_same_bits_twice)
{
  const Case c = cases()[5];
  const Outcome once = run_on(Device::cuda, c, classic(NormalModel::hertz, true));
  const Outcome twice = run_on(Device::cuda, c, classic(NormalModel::hertz, true));
  EXPECT_TRUE(same_bytes(once.force, twice.force));
  EXPECT_TRUE(same_bytes(once.springs, twice.springs));
  EXPECT_EQ(once.totals.energy, twice.totals.energy);
}

}    // namespace
