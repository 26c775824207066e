#include "effects/effects.h"

#include "grid/flat_grid.h"
#include "mesh/triangle_soup.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <random>

namespace lsdcd {

namespace {

constexpr Real kHalf = 50, kRadius = 0.5, kOverlap = 5e-3;

// 2 n^2 triangles at z = 0 over [-kHalf, kHalf]^2.
TriangleSoup flat_floor(int n)
{
  TriangleSoup soup;
  soup.source = "floor";
  const auto node = [n](int i, int j) {
    return Vec3{-kHalf + 2 * kHalf * i / n, -kHalf + 2 * kHalf * j / n, 0};
  };
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++)
      soup.corners.insert(soup.corners.end(), {node(i, j), node(i + 1, j), node(i + 1, j + 1),
                                               node(i, j), node(i + 1, j + 1), node(i, j + 1)});
  return soup;
}

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
    for (const Vec3 &p : at)
      for (int k = 0; k < 3; k++) {
        x.push_back(p[k]);
        v.push_back(speed(random));
        omega.push_back(speed(random));
      }
    radius.assign(n, kRadius);
    mass.assign(n, 1);
    temperature.assign(n, 300);
    heat.assign(n, 0);
    force.assign(3 * n, 0);
    torque.assign(3 * n, 0);
  }
  Spheres spheres()
  {
    Spheres s;
    s.n = static_cast<int>(radius.size());
    s.x = x.data();
    s.v = v.data();
    s.omega = omega.data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = force.data();
    s.torque = torque.data();
    s.temperature = temperature.data();
    s.heat_flow = heat.data();
    return s;
  }
  std::vector<Real> x, v, omega, radius, mass, force, torque, temperature, heat;
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

}    // namespace

std::vector<EffectCost> measure_effects(const std::vector<EffectCase> &cases, Device device,
                                        int n_spheres, int repeats)
{
  const WallMesh mesh = weld(flat_floor(100), -1);
  GridSettings settings;
  Real cutoff = kRadius;
  for (const EffectCase &c : cases) cutoff = std::max(cutoff, cutoff_of(c.settings.law, kRadius));
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
      one.engine->start(bed.spheres(), step);
      one.engine->collect();
      const double took = seconds(on_cpu) - start;
      if (r >= 0) one.ns.push_back(1e9 * took / one.engine->totals().contacts);
    }

  std::vector<EffectCost> costs;
  for (Runner &one : runners) {
    std::sort(one.ns.begin(), one.ns.end());
    costs.push_back({one.engine->backend(), static_cast<int>(one.engine->totals().contacts),
                     repeats, one.ns[one.ns.size() / 2], one.ns.front(), one.ns.back(),
                     one.engine->bytes()});
  }
  return costs;
}

}    // namespace lsdcd
