// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of a step of the wall: contacts, forces, springs, with particles that lie where the
// engine computes. Candidate spheres and their neighbour lists are used again, or made again in
// each step.
#include "bench.h"

#include "contact/spring.h"
#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "mesh/welded_mesh.h"
#include "study/spheres.h"
#include "support/sphere_arrays.h"

#include <random>

using namespace lsdcd;

namespace {

constexpr Real kCutoff = 1;
constexpr SphereBox kCube = {{-50, -50, 0}, {50, 50, 100}, kCutoff, 1};    // the paper's

SphereArrays make_bodies(int n, Order order)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Real> speed(-1, 1);
  SphereArrays bodies;
  for (const Sphere &s : make_spheres(kCube, n, order)) {
    Vec3 v, omega;
    for (int k = 0; k < 3; k++) {
      v[k] = speed(random);
      omega[k] = speed(random);
    }
    bodies.add({s.x, s.y, s.z}, s.r, 1, v, omega);
  }
  return bodies;
}

// Bytes that a step must move: position and radius of every sphere, or of every
// candidate; of one that touches v, omega and mass, and force and torque both ways; of a contact
// its spring both ways.
constexpr double kPlaceAndRadius = 4 * sizeof(Real);
double bytes_of_touching(double contacts)
{
  return contacts * ((7 + 2 * 6) * sizeof(Real) + 2 * sizeof(Spring));
}

void fill(BenchRow &row, const std::string &what, WallEngine &engine, const ViewOf<StepGrid> &grid,
          int n)
{
  row.what = what;
  row.length = grid.length;
  row.spheres = n;
  row.facts =
      format("near=%d contacts=%lld ns_per_near=%.1f grid_mb=%.1f engine_mb=%.1f",
             engine.n_candidates(), static_cast<long long>(engine.results().totals().contacts),
             row.timing.median_ms * 1e6 / std::max(1, engine.n_candidates()),
             grid.block_bytes / 1e6, engine.bytes() / 1e6);
}

void measure_in_place(const SphereArrays &bodies, const ViewOf<StepGrid> &grid, Device device,
                      int repeats, BenchRows &rows, BenchRow row)
{
  const bool cuda = device == Device::cuda;
  EngineSettings e;
  e.device = device;
  e.law() = usual_law(NormalModel::hertz, true);
  const auto engine = cuda ? make_cuda_engine_in_place(e, 0, nullptr) : make_cpu_engine(e);
  engine->set_grid(grid);
  SphereArraysOn there(cuda);
  const Spheres s = there.put(bodies);
  StepSettings step;
  step.dt = 1e-6;
  const int n_steps = cuda ? 20 : 1;    // between two looks, which wait
  for (bool anew : {false, true}) {
    engine->choose(s, 0);
    row.timing = time_it(
        repeats,
        [&] {
          for (int k = 0; k < n_steps; k++) {
            if (anew) engine->choose(s, 0);
            engine->step(s, step);
          }
          engine->read_diagnostics();
        },
        n_steps);
    fill(row, std::string("hertz/history, in place") + (anew ? ", chosen anew" : ""), *engine, grid,
         s.n);
    // The near ones are known by their numbers.
    row.bytes =
        bytes_of_touching(engine->results().totals().contacts) +
        (anew ? s.n * kPlaceAndRadius : engine->n_candidates() * (kPlaceAndRadius + sizeof(int)));
    rows.add(row);
  }
}

FlatOf<StepGrid> grid_of(const WeldedMesh &mesh, Real length, Device device)
{
  StepGridSettings settings;
  settings.length = length;
  settings.cutoff = kCutoff;
  settings.for_gpu = device == Device::cuda;
  return FlatOf(build_grid(mesh, settings, settings.for_gpu));
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e5 : 1e7);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 3 : 9;
  for (Device device : o.devices) {
    rows.begin(device);
    for (Order order : {Order::random, Order::sorted}) {
      const SphereArrays bodies = make_bodies(n, order);
      for (const TriangleSoup &soup : cylinders(o, 1e5)) {
        const WeldedMesh mesh = weld(soup, -1);
        BenchRow row;
        row.triangles = mesh.faces.size();
        row.order = order == Order::sorted ? "sorted" : "random";
        const FlatOf<StepGrid> grid = grid_of(mesh, o.length > 0 ? o.length : 0.2, device);
        measure_in_place(bodies, grid.view(), device, repeats, rows, row);
      }
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "step",
                   "Steps of the wall, with particles where the engine computes: CSV.", measure);
}
