// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The CUDA engine against the CPU engine: one source, so the same bits.
#include "effects/effects.h"
#include "support/crowd.h"
#include "support/fake_host.h"
#include "support/grains.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>

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

const ContactLaw kStyles[] = {classic(NormalModel::hooke, false), classic(NormalModel::hooke, true),
                              classic(NormalModel::hertz, true)};

template <class Settings>
void expect_the_same_grid(const Case &c, int nearest, bool in_floats = false)
{
  const WeldedMesh mesh = mesh_of(c);
  Settings g;
  g.within = within(c);
  g.cutoff = c.cutoff;
  g.length = c.length;
  g.nearest = nearest;
  if constexpr (std::is_same_v<Settings, QueryGridSettings>) g.in_floats = in_floats;
  const GridFor<Settings> cpu = build_grid(mesh, g, false), cuda = build_grid(mesh, g, true);
  std::vector<char> a(flat_bytes(cpu)), b(flat_bytes(cuda));
  flatten(cpu, a.data());
  flatten(cuda, b.data());
  EXPECT_TRUE(same_bytes(a, b)) << c.name << ", nearest " << nearest;
  EXPECT_GT(cuda.lists.entries.size() + cuda.lists.cells.size(), 0u) << c.name;
}

TEST(cuda_grid, has_the_same_lists_as_the_cpu_grid)
{
  for (const Case &c : cases()) {
    expect_the_same_grid<StepGridSettings>(c, 0);
    expect_the_same_grid<QueryGridSettings>(c, 0);
    expect_the_same_grid<QueryGridSettings>(c, 3, true);
  }
}

// Same source, no contraction, IEEE division and root on both: no tolerance.
TEST(cuda_engine, gives_what_classic_styles_give_on_the_cpu)
{
  for (const Case &c : cases())
    for (const ContactLaw &law : kStyles)
      expect_same(run_on(Device::cpu, c, law), run_on(Device::cuda, c, law), c.name);
}

TEST(cuda_engine, gives_what_the_cpu_gives_however_it_searches)
{
  const ContactLaw law = classic(NormalModel::hertz, true);
  for (const Search &search : other_searches())
    for (const Case &c : cases())
      expect_same(run_on(Device::cpu, c, law, search), run_on(Device::cuda, c, law, search),
                  std::string(c.name) + ", " + search.name);
}

TEST(cuda_engine, gives_what_granular_laws_give_on_the_cpu)
{
  for (const Case &c : cases())
    for (NormalModel normal :
         {NormalModel::hooke, NormalModel::hertz, NormalModel::dmt, NormalModel::jkr}) {
      const Outcome cpu = run_on(Device::cpu, c, everything(normal));
      const Outcome cuda = run_on(Device::cuda, c, everything(normal));
      expect_same(cpu, cuda, c.name);
      EXPECT_GT(cpu.extra.size(), 0u) << c.name;
    }
}

// Compares what oka wears off, and leaves it out of what is compared to the bit: pow() of a GPU and that of a CPU may each differ by a
// rounding from the exact power, and four of them are multiplied.
void compare_wear_by_impact(Outcome &cpu, Outcome &cuda, const std::string &name)
{
  constexpr Real kRoundings = 16 * std::numeric_limits<Real>::epsilon();
  ASSERT_EQ(cpu.contacts.size(), cuda.contacts.size()) << name;
  Real worn = 0;
  for (std::size_t k = 0; k < cpu.contacts.size(); k++) {
    Real &a = cpu.contacts[k].wear_power, &b = cuda.contacts[k].wear_power;
    EXPECT_NEAR(a, b, kRoundings * a) << name;
    worn += a;
    a = b = 0;
  }
  EXPECT_GT(worn, 0) << name;
}

TEST(cuda_engine, gives_what_every_effect_gives_on_the_cpu)
{
  const std::vector<Case> walls = cases();
  for (const EffectCase &effect : effect_cases()) {
    const Case &c = walls[effect.name.size() % walls.size()];
    const EngineSettings &s = effect.settings;
    Outcome cpu = run_on(Device::cpu, c, s.law(), kComplete, s);
    Outcome cuda = run_on(Device::cuda, c, s.law(), kComplete, s);
    if (s.wears_by_impact()) compare_wear_by_impact(cpu, cuda, effect.name + ", " + c.name);
    expect_same(cpu, cuda, effect.name + ", " + c.name);
    // Walls keep contacts for themselves, for a body, for their books and for impacts: then these are compared, too.
    const bool kept = s.contacts || s.bodies || s.law().keeps_forces || s.impact_speed > 0;
    EXPECT_EQ(cpu.contacts.empty(), !kept) << effect.name << ", " << c.name;
  }
}

// A wall of one triangle under n spheres, which it steps as LAMMPS would; they lie 1e-3 deep and slide.
struct Floor {
  FakeHost host;
  Grains grains;
  std::unique_ptr<Wall> wall;

  Floor(Device device, int n)
  {
    host.simulation = wide_box();
    WallSpec spec;
    spec.laws.resize(1);
    spec.laws[0].law = classic(NormalModel::hooke, true);
    spec.device = device;
    spec.meshes.resize(1);
    TriangleSoup soup;
    soup.corners = {{-40, -40, 0}, {40, -40, 0}, {0, 40, 0}};
    spec.meshes[0].mesh = welded(soup);
    wall = std::make_unique<Wall>(host, spec, WallUnits(), WallBackend(), "",
                                  StepClock{0, 0, 0, 1e-3});
    for (int i = 0; i < n; i++) {
      grains.add({-10 + 0.4 * (i % 50), -10 + 0.4 * (i / 50), 0.199}, 0.2);
      grains.v.back() = {0.1, 0.02, 0};
    }
  }

  void step(std::int64_t number, bool look)
  {
    const std::size_t n = grains.x.size();
    for (std::size_t i = 0; i < n; i++) grains.force[i] = grains.torque[i] = {0, 0, 0};
    wall->history().grow(static_cast<int>(n));
    StepInput input;
    input.step = {number, 1e-3, number == 0 ? Step::setup : Step::step};
    input.look = input.new_spheres = look;
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = 0.05;
    wall->begin(grains.spheres(), input);
    wall->finish(grains.spheres());
  }
  // Lifts all spheres but some, and looks at them at once and two steps later, when it is known who is near.
  void go(std::int64_t first, int left)
  {
    for (std::size_t i = left; i < grains.x.size(); i++) grains.x[i].z = 5;
    for (int k = 0; k < 6; k++) step(first + k, k == 0 || k == 2);
  }
  long changes() const
  {
    return std::count_if(host.lines.begin(), host.lines.end(), [](const std::string &line) {
      return line.find("from now on") != std::string::npos;
    });
  }
};

TEST(device_automatic, goes_to_the_cpu_and_back_with_the_same_bits)
{
  Floor cpu(Device::cpu, 1000), any(Device::automatic, 1000);
  for (Floor *floor : {&cpu, &any}) {
    floor->wall->begin_run(0, false);
    floor->go(0, 1000);
  }
  EXPECT_EQ(any.changes(), 0) << "1000 spheres are for a GPU, where it began";
  EXPECT_TRUE(same_bytes(cpu.grains.force, any.grains.force));
  for (Floor *floor : {&cpu, &any}) floor->go(6, 50);
  EXPECT_EQ(any.changes(), 1) << "50 spheres are for the CPU";
  EXPECT_NE(cpu.grains.force[0].x, 0) << "springs went along";
  EXPECT_TRUE(same_bytes(cpu.grains.force, any.grains.force));
  EXPECT_TRUE(same_bytes(cpu.grains.torque, any.grains.torque));
  EXPECT_EQ(cpu.wall->totals().mesh(0).force.x, any.wall->totals().mesh(0).force.x);
}

}    // namespace
