// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The effect of the length of cells on the time of a step and on memory: three meshes, spheres anywhere
// in their boxes, cells of a quarter to four times the default.
#include "bench.h"

#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "grid/plan/grid_plan.h"
#include "mesh/welded_mesh.h"
#include "support/device_memory.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>

using namespace lsdcd;

namespace {

struct BenchMesh {
  const char *name;
  TriangleSoup soup;
  Real radius;    // of the largest sphere; the smallest has half of it
};

// A floor of 2 n^2 triangles over [0, 100]^2, bumps of every length, none steeper than 0.5.
TriangleSoup bumpy_floor(int n)
{
  TriangleSoup soup;
  soup.source = "bumpy floor";
  const auto node = [n](int i, int j) {
    const Real x = Real(100) * i / n, y = Real(100) * j / n;
    Real z = 0;
    for (Real k = 0.1; k < 20; k *= 3) z += 0.05 / k * std::sin(k * x + k) * std::cos(k * y - k);
    return Vec3{x, y, z};
  };
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++)
      for (const Vec3 &corner : {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j),
                                 node(i + 1, j + 1), node(i, j + 1)})
        soup.corners.push_back(corner);
  return soup;
}

// n spheres anywhere in the box of a mesh and a radius beyond it, sorted by cubes of four radii as a
// host sorts its atoms.
struct Anywhere {
  Anywhere(const MeshReport &box, Real radius, int n)
  {
    std::mt19937_64 random(3);
    const auto between = [&](Real lo, Real hi) {
      return lo + (hi - lo) * Real(random() >> 11) * Real(0x1p-53);
    };
    std::vector<Vec3> at(n);
    for (Vec3 &p : at)
      for (int k = 0; k < 3; k++) p[k] = between(box.lo[k] - radius, box.hi[k] + radius);
    const auto cube = [&](const Vec3 &p) {
      const auto slot = [&](int k) { return std::int64_t((p[k] - box.lo[k]) / (4 * radius) + 1); };
      return std::make_tuple(slot(2), slot(1), slot(0));
    };
    std::sort(at.begin(), at.end(),
              [&](const Vec3 &a, const Vec3 &b) { return cube(a) < cube(b); });
    for (const Vec3 &p : at) {
      x.insert(x.end(), {p.x, p.y, p.z});
      r.push_back(between(radius / 2, radius));
    }
  }
  std::vector<Real> x, r;
};

class Bed {
 public:
  Bed(const Anywhere &at, Device device) :
      cuda_(device == Device::cuda), x_(cuda_), r_(cuda_), zero_(cuda_)
  {
    settings_.device = device;
    settings_.law() = classic_law(NormalModel::hertz, true);
    settings_.law().k_normal = 1e5;
    settings_.law().k_tangent = 3e4;
    settings_.law().mu = Real(0.5);
    const std::size_t n = at.r.size();
    std::vector<Real> zero(13 * n, 0);
    std::fill_n(zero.begin(), n, Real(1));
    Real *to = zero_.put(zero);
    spheres_.n = static_cast<int>(n);
    spheres_.x = x_.put(at.x);
    spheres_.radius = r_.put(at.r);
    spheres_.mass = to;
    spheres_.v = to + n;
    spheres_.omega = to + 4 * n;
    spheres_.force = to + 7 * n;
    spheres_.torque = to + 10 * n;
  }

  void use(const GridView &grid)
  {
    engine_ = cuda_ ? make_cuda_engine_in_place(settings_, 0, nullptr) : make_cpu_engine(settings_);
    engine_->set_grid(grid);
  }
  // A choice of near spheres, with `margin` for what they move until the next, and steps.
  void run(Real margin, int steps)
  {
    engine_->choose(spheres_, margin);
    StepSettings step;
    step.dt = Real(1e-9);
    for (int k = 0; k < steps; k++) {
      engine_->step(spheres_, step);
    }
    engine_->read_diagnostics();
  }
  const WallEngine &engine() const { return *engine_; }

 private:
  bool cuda_;
  EngineSettings settings_;
  DeviceArray<Real> x_, r_, zero_;
  Spheres spheres_;
  std::unique_ptr<WallEngine> engine_;
};

void measure(const BenchOptions &o, BenchRows &rows)
{
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 9;
  const std::vector<BenchMesh> meshes = {
      {"vessel", read_stl(LSDCD_ROOT "/examples/vessel/vessel.stl"), Real(1.55)},
      {"cylinder", cylinder_mesh(o.quick ? 32 : 250, o.quick ? 8 : 200, 50, 100), 1},
      {"bumpy floor", bumpy_floor(o.quick ? 20 : 707), 1}};
  for (Device device : o.devices) {
    rows.begin(device);
    const bool cuda = device == Device::cuda;
    const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : cuda ? 1e6 : 1e5);
    for (const BenchMesh &m : meshes) {
      const WeldedMesh mesh = weld(m.soup, -1);
      Bed bed(Anywhere(mesh.report, m.radius, n), device);
      GridSettings settings;
      settings.cutoff = m.radius;
      const Real usual = default_length(mesh, m.radius, ListKind::complete(), false);
      for (Real factor : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0}) {
        if (o.quick && factor < 0.7) continue;
        settings.length = factor * usual;
        const double began = clock_ms();
        const FlatGrid grid(build_grid(mesh, settings, cuda));
        const double build_ms = clock_ms() - began;
        bed.use(grid.view());
        // Half a skin of a tenth of the radius, as a host's list of neighbours has it.
        const Real margin = Real(0.05) * m.radius;
        BenchRow row;
        row.triangles = mesh.faces.size();
        row.spheres = n;
        row.length = settings.length;
        row.order = "sorted";
        double ms[2] = {};
        for (int steps : {1, 21}) {
          row.timing = time_it(repeats, [&] { bed.run(margin, steps); });
          ms[steps > 1] = row.timing.median_ms;
          row.what = std::string(m.name) +
                     (steps > 1 ? ", a choice and 21 steps" : ", a choice and a step");
          row.facts = format("factor=%.2f near=%d contacts=%lld grid_mb=%.1f build_ms=%.4g", factor,
                             bed.engine().n_candidates(),
                             static_cast<long long>(bed.engine().totals().contacts),
                             grid.view().block_bytes / 1e6, build_ms);
          if (steps > 1) row.facts += format(" step_ms=%.5f", (ms[1] - ms[0]) / 20);
          rows.add(row);
        }
      }
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "cells", "Steps and memory by the length of cells: CSV.", measure);
}
