// What a step of the wall costs: choosing spheres, contacts, forces, springs,
// totals, with the host arrays of a CPU LAMMPS. Prints CSV.
// Usage: bench_step [spheres [repeats]]
#include "bench.h"

#include "engine/wall_engine.h"
#include "grid/flat_grid.h"
#include "support/meshes.h"

#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <random>

using namespace lsdcd;

namespace {

struct Bodies {
  std::vector<Real> x, v, omega, radius, mass, force, torque;
};

// Spheres of radius 0.2 to 1 uniform in the box around the cylinder, as in the
// paper; sorted as LAMMPS sorts atoms: by bins, x fastest.
Bodies make_bodies(int n, bool sorted)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Real> u(-51, 51), w(-1, 101), r(0.2, 1), speed(-1, 1);
  std::vector<Vec3> x(n);
  for (Vec3 &p : x) p = {u(random), u(random), w(random)};
  if (sorted) {
    const auto bin = [](const Vec3 &p) {
      return (std::int64_t((p.z + 1) / 2) * 64 + std::int64_t((p.y + 51) / 2)) * 64 +
             std::int64_t((p.x + 51) / 2);
    };
    std::sort(x.begin(), x.end(), [&](const Vec3 &a, const Vec3 &b) { return bin(a) < bin(b); });
  }
  Bodies b;
  for (const Vec3 &p : x)
    for (int k = 0; k < 3; k++) {
      b.x.push_back(p[k]);
      b.v.push_back(speed(random));
      b.omega.push_back(speed(random));
    }
  for (int i = 0; i < n; i++) {
    b.radius.push_back(r(random));
    b.mass.push_back(1);
  }
  b.force.assign(3 * n, 0);
  b.torque.assign(3 * n, 0);
  return b;
}

}    // namespace

int main(int argc, char **argv)
{
  const int n = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 9;
  std::string why;
  const bool cuda = cuda_available(&why);
  if (!cuda) std::fprintf(stderr, "CUDA rows are left out: %s\n", why.c_str());
  std::puts("bench,triangles,length,device,style,order,spheres,near,contacts,repeats,median_ms,"
            "min_ms,max_ms,ns_per_sphere,ns_per_near_sphere,grid_bytes,engine_bytes,compiler,"
            "commit");
  struct {
    int n, m;
  } const cylinders[] = {{40, 1}, {100, 49}, {400, 124}};
  const struct {
    LawStyle style;
    const char *name;
  } styles[] = {{LawStyle::hooke, "hooke"}, {LawStyle::hertz_history, "hertz/history"}};
  for (bool sorted : {false, true}) {
    Bodies b = make_bodies(n, sorted);
    for (const auto &c : cylinders) {
      const WallMesh mesh = weld(cylinder_mesh(c.n, c.m, 50, 100), -1);
      GridSettings settings;
      settings.reach = 1;
      const TriangleGrid grid = build_grid(mesh, settings, cuda);
      const FlatGrid flat(grid);
      for (bool on_cuda : {false, true})
        for (const auto &style : styles) {
          if (on_cuda && !cuda) continue;
          EngineSettings e;
          e.device = on_cuda ? Device::cuda : Device::cpu;
          e.law.style = style.style;
          e.law.k_normal = 1e5;
          e.law.k_tangent = 3e4;
          e.law.gamma_normal = 50;
          e.law.gamma_tangent = 25;
          e.law.mu = 0.5;
          auto engine = make_engine(e);
          engine->set_grid(flat.view());
          SpringStore springs;
          springs.grow(n);
          Spheres s;
          s.n = n;
          s.x = b.x.data();
          s.v = b.v.data();
          s.omega = b.omega.data();
          s.radius = b.radius.data();
          s.mass = b.mass.data();
          s.force = b.force.data();
          s.torque = b.torque.data();
          StepSettings step;
          step.dt = 1e-6;
          const Timing t = time_it(repeats, [&] {
            engine->start(s, step, &springs);
            engine->collect();
          });
          std::printf("step,%zu,%.6g,\"%s\",%s,%s,%d,%d,%lld,%d,%.4f,%.4f,%.4f,%.2f,%.1f,%zu,%zu,"
                      "\"%s\",%s\n",
                      mesh.faces.size(), grid.length, engine->backend().c_str(), style.name,
                      sorted ? "sorted" : "random", n, engine->n_near(),
                      static_cast<long long>(engine->totals().contacts), t.repeats, t.median_ms,
                      t.min_ms, t.max_ms, t.median_ms * 1e6 / n,
                      t.median_ms * 1e6 / std::max(1, engine->n_near()), grid.report.bytes,
                      engine->bytes(), compiler(), LSDCD_COMMIT);
          std::fflush(stdout);
        }
    }
  }
}
