// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of every effect of a wall: rows for doc/effects.md, as CSV.
//
// Spheres lie on a floor of 20 000 triangles, each with one contact, in a step as the fix makes
// it. Cases take turns, so that what disturbs the machine disturbs all alike; the least of the
// times is nearest to the truth, since disturbances only add.
#include "bench.h"

#include "effects/effects.h"

#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "support/meshes.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>

using namespace lsdcd;

namespace {

constexpr Real kHalf = 50, kRadius = 0.5, kOverlap = 5e-3;

// Spheres that touch the floor, in the order of bins as LAMMPS sorts them.
struct Bed {
  explicit Bed(int n)
  {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<Real> place(-0.98 * kHalf, 0.98 * kHalf), speed(-1, 1);
    std::vector<Vec3> at(n);
    for (Vec3 &p : at) p = {place(random), place(random), kRadius - kOverlap};
    const auto bin = [](const Vec3 &p) {
      return std::int64_t(p.y + kHalf) * 1000 + std::int64_t(p.x + kHalf);
    };
    std::sort(at.begin(), at.end(), [&](const Vec3 &a, const Vec3 &b) { return bin(a) < bin(b); });
    for (const Vec3 &p : at) {
      Vec3 v, omega;
      for (int k = 0; k < 3; k++) {
        v[k] = speed(random);
        omega[k] = speed(random);
      }
      arrays.add(p, kRadius, 1, v, omega);
    }
    arrays.temperature.assign(n, 300);
    arrays.heat_flow.assign(n, 0);
  }
  Spheres spheres() { return arrays.spheres(); }

  SphereArrays arrays;
};

// On the CPU the time of all threads, which others that use the machine do not add to.
double seconds(bool of_processor)
{
  if (of_processor) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Runner {
  std::unique_ptr<WallEngine> engine;
  std::vector<double> ns;
};

struct EffectCost {
  std::string device;
  int contacts;
  double median_ns, min_ns, max_ns;    // per contact
  std::size_t engine_bytes;            // held for all of them
};

std::vector<EffectCost> measure_effects(const std::vector<EffectCase> &cases, Device device,
                                        int n_spheres, int repeats)
{
  const WeldedMesh mesh = weld(floor_mesh(100, kHalf), -1);
  GridSettings settings;
  Real cutoff = kRadius;
  for (const EffectCase &c : cases) cutoff = std::max(cutoff, cutoff_of(c.settings.law(), kRadius));
  settings.cutoff = cutoff;
  const TriangleGrid grid = build_grid(mesh, settings);
  const FlatGrid flat(grid);

  Bed bed(n_spheres);
  StepSettings step;
  step.dt = 1e-7;
  std::vector<Runner> runners;
  for (const EffectCase &c : cases) {
    EngineSettings e = c.settings;
    e.device = device;
    runners.push_back({make_engine(e), {}});
    runners.back().engine->set_grid(flat.view());
    runners.back().engine->choose(bed.spheres(), 0);
  }
  for (int r = -1; r < repeats; r++)    // the first round warms up
    for (Runner &one : runners) {
      const bool on_cpu = one.engine->backend().compare(0, 3, "CPU") == 0;
      const double start = seconds(on_cpu);
      one.engine->step(bed.spheres(), step);
      const double took = seconds(on_cpu) - start;
      if (r >= 0) one.ns.push_back(1e9 * took / one.engine->results().totals().contacts);
    }

  std::vector<EffectCost> costs;
  for (Runner &one : runners) {
    std::sort(one.ns.begin(), one.ns.end());
    costs.push_back(
        {one.engine->backend(), static_cast<int>(one.engine->results().totals().contacts),
         one.ns[one.ns.size() / 2], one.ns.front(), one.ns.back(), one.engine->bytes()});
  }
  return costs;
}

// The least cost over that of the case that lacks the effect, ns; 0 where there is none.
double cost_over(const std::vector<EffectCase> &cases, const std::vector<EffectCost> &costs,
                 std::size_t i)
{
  for (std::size_t k = 0; k < cases.size(); k++)
    if (cases[k].name == cases[i].over) return costs[i].min_ns - costs[k].min_ns;
  return 0;
}

// Fields are separated by semicolons: words and devices have commas in them.
void measure(Device device, int n_spheres, int repeats, const char *commit)
{
  const std::vector<EffectCase> cases = effect_cases();
  const std::vector<EffectCost> costs = measure_effects(cases, device, n_spheres, repeats);
  std::printf("name;words;over;contacts;repeats;median_ns;min_ns;max_ns;over_ns;bytes_per_atom;"
              "bytes_per_contact;engine_bytes;device;compiler;commit\n");
  for (std::size_t i = 0; i < cases.size(); i++) {
    const EffectCase &c = cases[i];
    const EffectCost &cost = costs[i];
    std::printf("%s;%s;%s;%d;%d;%.2f;%.2f;%.2f;%.2f;%d;%d;%zu;%s;%s;%s\n", c.name.c_str(),
                c.words.c_str(), c.over.c_str(), cost.contacts, repeats, cost.median_ns,
                cost.min_ns, cost.max_ns, cost_over(cases, costs, i), bytes_per_atom(c.settings),
                bytes_per_contact(c.settings), cost.engine_bytes, cost.device.c_str(), compiler(),
                commit);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  const int spheres = argc == 5 ? std::atoi(argv[2]) : 0,
            repeats = argc == 5 ? std::atoi(argv[3]) : 0;
  const bool cuda = argc > 1 && std::strcmp(argv[1], "cuda") == 0;
  if (spheres < 1 || repeats < 1 || (!cuda && std::strcmp(argv[1], "cpu") != 0)) {
    std::fprintf(stderr, "usage: bench_effects cpu|cuda SPHERES REPEATS COMMIT\n");
    return 2;
  }
  try {
    measure(cuda ? Device::cuda : Device::cpu, spheres, repeats, argv[4]);
  } catch (const InputError &e) {
    std::fprintf(stderr, "bench_effects: %s\n", e.what());
    return 1;
  }
  return 0;
}
