// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/crowd.h"

#include "support/kept_springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lsdcd {

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

std::vector<Case> cases()
{
  return {{"cylinder of 160", cylinder_mesh(40, 1, 50, 100), 1, 0.4},
          {"cylinder of 10 000", cylinder_mesh(100, 49, 50, 100), 1, 0},
          {"cylinder of 100 000", cylinder_mesh(400, 124, 50, 100), 1, 0.4},
          {"floor of 20 000", floor_mesh(100, 10, 7), 0.3, 0},
          {"box", box_mesh({0, 0, 0}, {10, 10, 10}), 0.5, 0},
          {"random soup", random_soup(500, 3), 0.7, 0},
          {"random soup in a periodic box", random_soup(500, 3), 0.7, 0, true}};
}

namespace {

PeriodicBox box_of(const MeshReport &report)
{
  PeriodicBox box;
  const Vec3 size = report.hi - report.lo;
  box.corner = report.lo + 0.05 * size;
  for (int k = 0; k < 3; k++) {
    box.edge[k] = {0, 0, 0};
    box.edge[k][k] = 0.9 * size[k];
    box.periodic[k] = true;
  }
  box.margin = 1;
  return box;
}

}    // namespace

WeldedMesh mesh_of(const Case &c)
{
  const WeldedMesh mesh = weld(c.soup, -1);
  if (!c.periodic) return mesh;
  const PeriodicBox box = box_of(mesh.report);
  return with_images(mesh, box, c.cutoff + box.margin);
}

Box within(const Case &c)
{
  if (!c.periodic) return kNoLimit;
  const PeriodicBox box = box_of(weld(c.soup, -1).report);
  return box.bounds({box.margin, box.margin, box.margin});
}

ContactLaw classic(NormalModel normal, bool history)
{
  ContactLaw law = classic_law(normal, history);
  law.k_normal = 1e5;
  law.k_tangent = 2e4;
  law.eta = 50;
  law.gamma_tangent = 25;
  law.mu = 0.4;
  return law;
}

ContactLaw everything(NormalModel normal)
{
  ContactLaw law;
  law = granular_law(NormalModel::hooke);
  ContactLaw &g = law;
  g.normal = normal;
  g.k_normal = 1e5;
  g.modulus = 0.75e5;
  g.surface_energy = 300;
  g.eta = 20;
  g.tangential = TangentialModel::mindlin_rescale_force;
  g.k_tangent = 5e4;
  g.xgammat = 0.7;
  g.mu = 0.4;
  g.rolling = {RollingModel::sds, {3e4, 20, 0.1}};
  g.twisting = TwistingModel::marshall;
  g.heat = {HeatModel::area, {3}};
  return law;
}

std::vector<Search> other_searches()
{
  return {{"nearest 2", 2}, {"nearest 3", 3}};
}

namespace {

struct Wall {
  std::string name;
  StepGridSettings settings;
  MeshReport report;
  FlatOf<StepGrid> flat;
};

// Engines are compared on one wall after another: the last one is kept.
const Wall &wall_of(const Case &c, const StepGridSettings &g)
{
  static Wall last;
  const StepGridSettings &had = last.settings;
  if (last.name == c.name && had.cutoff == g.cutoff && had.nearest == g.nearest) return last;
  const WeldedMesh mesh = mesh_of(c);
  last = {c.name, g, mesh.report, FlatOf(build_grid(mesh, g))};
  return last;
}

}    // namespace

namespace {

void wrap(const Case &c, std::vector<Real> &x)
{
  const PeriodicBox box = box_of(weld(c.soup, -1).report);
  for (std::size_t i = 0; i < x.size(); i++) {
    const int d = static_cast<int>(i % 3);
    const Real size = box.edge[d][d];
    x[i] -= size * std::floor((x[i] - box.corner[d]) / size);
  }
}

}    // namespace

Outcome run_steps(const Case &c, const ContactLaw &law, const EngineMaker &make, int n_spheres,
                  const Search &search, const EngineSettings &wall)
{
  StepGridSettings g;
  g.cutoff = cutoff_of(law, c.cutoff);
  g.length = c.length;
  g.nearest = search.nearest;
  g.within = within(c);
  const Wall &built = wall_of(c, g);

  EngineSettings e = wall;
  e.law() = law;
  const auto engine = make(e);
  engine->set_grid(built.flat.view());

  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> unit(0, 1), speed(-3, 3);
  SphereArrays a;
  a.heat_flow.resize(n_spheres);
  const Vec3 lo = built.report.lo - c.cutoff * Vec3{1, 1, 1};
  const Vec3 extent = built.report.hi + c.cutoff * Vec3{1, 1, 1} - lo;
  for (int i = 0; i < n_spheres; i++) {
    Vec3 x, v, omega;
    for (int k = 0; k < 3; k++) {
      x[k] = lo[k] + extent[k] * unit(random);
      v[k] = speed(random);
      omega[k] = speed(random);
    }
    const Real radius = c.cutoff * (0.2 + 0.8 * unit(random)), mass = 1 + unit(random);
    a.add(x, radius, mass, v, omega);
    a.temperature.push_back(300 + speed(random));
  }
  ContactHistory springs(law.n_extra());
  springs.grow(n_spheres);
  StepSettings step;
  step.wall_temperature = 310;
  step.dt = 1e-2;
  step.per_sphere = true;
  for (int k = 0; k < 5; k++) {
    a.clear_forces();
    step_once(*engine, a.spheres(), step, &springs);
    a.move(step.dt);
    if (c.periodic && k == 2) wrap(c, a.x);    // springs go over to what is touched there
  }
  Outcome out;
  for (int i = 0; i < n_spheres; i++) {
    out.force.push_back(vector_at(a.force, i));
    out.torque.push_back(vector_at(a.torque, i));
    for (const Spring &spring : springs_of(springs, i)) out.springs.push_back(spring);
    for (const Real number : extra_of(springs, i)) out.extra.push_back(number);
  }
  out.heat = a.heat_flow;
  out.totals = engine->results().totals();
  out.outputs = engine->results().touching();
  out.contacts = engine->results().contacts();
  return out;
}

void expect_same(const Outcome &a, const Outcome &b, const std::string &name)
{
  EXPECT_TRUE(same_bytes(a.force, b.force)) << name;
  EXPECT_TRUE(same_bytes(a.torque, b.torque)) << name;
  EXPECT_TRUE(same_bytes(a.springs, b.springs)) << name;
  EXPECT_TRUE(same_bytes(a.extra, b.extra)) << name;
  EXPECT_TRUE(same_bytes(a.heat, b.heat)) << name;
  EXPECT_TRUE(same_bytes(a.outputs, b.outputs)) << name;
  EXPECT_TRUE(same_bytes(a.contacts, b.contacts)) << name;
  EXPECT_EQ(a.totals.energy, b.totals.energy) << name;
  EXPECT_TRUE(a.totals.force == b.totals.force) << name;
  EXPECT_TRUE(a.totals.torque == b.totals.torque) << name;
  EXPECT_EQ(a.totals.contacts, b.totals.contacts) << name;
  EXPECT_EQ(a.totals.uncertified, b.totals.uncertified) << name;
  EXPECT_EQ(a.totals.largest_overlap_sphere, b.totals.largest_overlap_sphere) << name;
  EXPECT_GT(a.totals.contacts, 0) << name;
}

}    // namespace lsdcd
