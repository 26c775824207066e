// The CUDA engine against the CPU engine: one source, so the same bits.
#include "effects/effects.h"
#include "support/meshes.h"

#include "support/device.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

using namespace lsdcd;

namespace {

TriangleSoup random_soup(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> at(-5, 5), size(-1, 1);
  TriangleSoup soup;
  soup.source = "random";
  for (int i = 0; i < n; i++) {
    const Vec3 p = {at(random), at(random), at(random)};
    for (int k = 0; k < 3; k++)
      soup.corners.push_back(p + Vec3{size(random), size(random), size(random)});
  }
  return soup;
}

struct Case {
  const char *name;
  TriangleSoup soup;
  Real reach, length;
};

std::vector<Case> cases()
{
  return {{"cylinder of 160", cylinder_mesh(40, 1, 50, 100), 1, 0.4},
          {"cylinder of 10 000", cylinder_mesh(100, 49, 50, 100), 1, 0},
          {"cylinder of 100 000", cylinder_mesh(400, 124, 50, 100), 1, 0.4},
          {"floor of 20 000", floor_mesh(100, 10, 7), 0.3, 0},
          {"box", box_mesh({0, 0, 0}, {10, 10, 10}), 0.5, 0},
          {"random soup", random_soup(500, 3), 0.7, 0}};
}

template <class T>
bool same_bytes(const std::vector<T> &a, const std::vector<T> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

ContactLaw classic(LawStyle style)
{
  ContactLaw law;
  law.style = style;
  law.k_normal = 1e5;
  law.k_tangent = 2e4;
  law.gamma_normal = 50;
  law.gamma_tangent = 25;
  law.mu = 0.4;
  return law;
}

// `granular` with every further effect at once.
ContactLaw everything(NormalModel normal)
{
  ContactLaw law;
  law.style = LawStyle::granular;
  GranularLaw &g = law.granular;
  g.normal = normal;
  g.k_normal = 1e5;
  g.modulus = 0.75e5;
  g.cohesion = 300;
  g.eta = 20;
  g.tangential = TangentialModel::mindlin_rescale_force;
  g.k_tangent = 5e4;
  g.x_tangent = 0.7;
  g.mu = 0.4;
  g.rolling = true;
  g.k_roll = 3e4;
  g.gamma_roll = 20;
  g.mu_roll = 0.1;
  g.twisting = TwistingModel::marshall;
  g.heat = HeatModel::area;
  g.conductance = 3;
  return law;
}

// Spheres all over the box of a wall, some in motion, for a few steps on one backend.
struct Outcome {
  std::vector<Vec3> force, torque;
  WallTotals totals;
  std::vector<Spring> springs;
  std::vector<Real> extra, heat;
  std::vector<SphereOutput> outputs;
  std::vector<ContactRecord> records;
};

// How a wall is searched: settings of the grid and of the engine that belong together.
struct Search {
  const char *name;
  int nearest;
  bool exact;
  Precision precision;
};

constexpr Search kComplete = {"complete", 0, false, Precision::double_};

Outcome run_steps(const Case &c, const ContactLaw &law, Device device, int n_spheres,
                  const Search &search = kComplete, const EngineSettings &wall = {})
{
  const WallMesh mesh = weld(c.soup, -1);
  GridSettings g;
  g.reach = reach_of(law, c.reach);
  g.length = c.length;
  g.nearest = search.nearest;
  g.exact = search.exact;
  g.in_floats = search.precision != Precision::double_;
  const TriangleGrid grid = build_grid(mesh, g);
  const FlatGrid flat(grid);

  EngineSettings e = wall;
  e.law = law;
  e.device = device;
  e.precision = search.precision;
  auto engine = make_engine(e);
  engine->set_grid(flat.view());

  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> unit(0, 1), speed(-3, 3);
  std::vector<Real> x, v, omega, radius, mass, force(3 * n_spheres), torque(3 * n_spheres);
  std::vector<Real> temperature, heat(n_spheres);
  const Vec3 lo = mesh.report.lo - c.reach * Vec3{1, 1, 1};
  const Vec3 extent = mesh.report.hi + c.reach * Vec3{1, 1, 1} - lo;
  for (int i = 0; i < n_spheres; i++) {
    for (int k = 0; k < 3; k++) {
      x.push_back(lo[k] + extent[k] * unit(random));
      v.push_back(speed(random));
      omega.push_back(speed(random));
    }
    radius.push_back(c.reach * (0.2 + 0.8 * unit(random)));
    mass.push_back(1 + unit(random));
    temperature.push_back(300 + speed(random));
  }
  SpringStore springs(law.n_extra());
  springs.grow(n_spheres);
  Spheres s;
  s.n = n_spheres;
  s.x = x.data();
  s.v = v.data();
  s.omega = omega.data();
  s.radius = radius.data();
  s.mass = mass.data();
  s.force = force.data();
  s.torque = torque.data();
  s.temperature = temperature.data();
  s.heat_flow = heat.data();
  StepSettings step;
  step.wall_temperature = 310;
  step.dt = 1e-2;
  step.per_sphere = true;
  for (int k = 0; k < 5; k++) {
    std::fill(force.begin(), force.end(), 0);
    std::fill(torque.begin(), torque.end(), 0);
    engine->start(s, step, &springs);
    engine->collect();
    for (int i = 0; i < 3 * n_spheres; i++) x[i] += step.dt * v[i];
  }
  Outcome out;
  for (int i = 0; i < n_spheres; i++) {
    out.force.push_back({force[3 * i], force[3 * i + 1], force[3 * i + 2]});
    out.torque.push_back({torque[3 * i], torque[3 * i + 1], torque[3 * i + 2]});
    out.springs.insert(out.springs.end(), springs.of(i), springs.of(i) + springs.count(i));
    out.extra.insert(out.extra.end(), springs.extra_of(i),
                     springs.extra_of(i) + springs.count(i) * law.n_extra());
  }
  out.heat = heat;
  out.totals = engine->totals();
  out.outputs.assign(engine->sphere_output(), engine->sphere_output() + engine->n_touching());
  out.records.assign(engine->records(), engine->records() + engine->n_records());
  return out;
}

constexpr LawStyle kStyles[] = {LawStyle::hooke, LawStyle::hooke_history, LawStyle::hertz_history};

TEST(cuda_grid, has_the_same_lists_as_the_cpu_grid)
{
  for (const Case &c : cases()) {
    const WallMesh mesh = weld(c.soup, -1);
    GridSettings g;
    g.reach = c.reach;
    g.length = c.length;
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
    const WallMesh mesh = weld(c.soup, -1);
    GridSettings g;
    g.reach = c.reach;
    g.length = c.length;
    g.nearest = 3;
    g.exact = true;
    g.in_floats = true;
    const TriangleGrid cpu = build_grid(mesh, g, false), cuda = build_grid(mesh, g, true);
    std::vector<char> a(flat_bytes(cpu)), b(flat_bytes(cuda));
    flatten(cpu, a.data());
    flatten(cuda, b.data());
    EXPECT_TRUE(same_bytes(a, b)) << c.name;
    EXPECT_GT(cuda.complete.cells.size(), 0u) << c.name;
    EXPECT_GT(cuda.records.faces.size(), 0u) << c.name;
  }
}

TEST(cuda_engine, gives_the_forces_of_the_cpu_engine)
{
  // Same source, no contraction, IEEE division and root on both: no tolerance.
  for (const Case &c : cases())
    for (LawStyle style : kStyles) {
      const Outcome cpu = run_steps(c, classic(style), Device::cpu, 20000);
      const Outcome cuda = run_steps(c, classic(style), Device::cuda, 20000);
      EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << c.name;
      EXPECT_TRUE(same_bytes(cpu.torque, cuda.torque)) << c.name;
      EXPECT_GT(cpu.totals.contacts, 0) << c.name;
    }
}

TEST(cuda_engine, gives_the_forces_of_the_cpu_engine_however_it_searches)
{
  for (const Search &search : {Search{"nearest 2", 2, false, Precision::double_},
                               Search{"nearest 2 exact", 2, true, Precision::double_},
                               Search{"mixed", 0, false, Precision::mixed},
                               Search{"nearest 3, mixed", 3, false, Precision::mixed},
                               Search{"single", 0, false, Precision::single_}})
    for (const Case &c : cases()) {
      const Outcome cpu =
          run_steps(c, classic(LawStyle::hertz_history), Device::cpu, 20000, search);
      const Outcome cuda =
          run_steps(c, classic(LawStyle::hertz_history), Device::cuda, 20000, search);
      EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << c.name << ", " << search.name;
      EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << c.name << ", " << search.name;
      EXPECT_EQ(cpu.totals.uncertified, cuda.totals.uncertified) << c.name << ", " << search.name;
      EXPECT_GT(cpu.totals.contacts, 0) << c.name << ", " << search.name;
    }
}

TEST(cuda_engine, gives_the_springs_of_the_cpu_engine)
{
  for (const Case &c : cases()) {
    const Outcome cpu = run_steps(c, classic(LawStyle::hertz_history), Device::cpu, 20000);
    const Outcome cuda = run_steps(c, classic(LawStyle::hertz_history), Device::cuda, 20000);
    EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << c.name;
    EXPECT_GT(cpu.springs.size(), 0u) << c.name;
  }
}

TEST(cuda_engine, gives_the_totals_and_outputs_of_the_cpu_engine)
{
  for (const Case &c : cases()) {
    const Outcome cpu = run_steps(c, classic(LawStyle::hooke_history), Device::cpu, 20000);
    const Outcome cuda = run_steps(c, classic(LawStyle::hooke_history), Device::cuda, 20000);
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
      const Outcome cpu = run_steps(c, everything(normal), Device::cpu, 20000);
      const Outcome cuda = run_steps(c, everything(normal), Device::cuda, 20000);
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
    const Outcome cpu = run_steps(c, s.law, Device::cpu, 20000, kComplete, s);
    const Outcome cuda = run_steps(c, s.law, Device::cuda, 20000, kComplete, s);
    EXPECT_TRUE(same_bytes(cpu.force, cuda.force)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.torque, cuda.torque)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.springs, cuda.springs)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.extra, cuda.extra)) << effect.name << ", " << c.name;
    EXPECT_TRUE(same_bytes(cpu.records, cuda.records)) << effect.name << ", " << c.name;
    EXPECT_EQ(cpu.records.empty(), !s.records) << effect.name << ", " << c.name;
  }
}

TEST(cuda_engine, gives_the_same_bits_twice)
{
  const Case c = cases()[5];
  const Outcome once = run_steps(c, classic(LawStyle::hertz_history), Device::cuda, 20000);
  const Outcome twice = run_steps(c, classic(LawStyle::hertz_history), Device::cuda, 20000);
  EXPECT_TRUE(same_bytes(once.force, twice.force));
  EXPECT_TRUE(same_bytes(once.springs, twice.springs));
  EXPECT_EQ(once.totals.energy, twice.totals.energy);
}

}    // namespace
