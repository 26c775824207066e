// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of a step of the wall: contacts, forces, springs; with the arrays of a CPU LAMMPS, and
// with particles that lie where the engine computes. Candidate spheres and their neighbour lists
// are used again, or made again in each step.
#include "bench.h"

#include "engine/engine.h"
#include "grid/flat_grid.h"
#include "mesh/welded_mesh.h"
#include "study/spheres.h"
#include "support/sphere_arrays.h"

#include <random>

using namespace lsdcd;

namespace {

constexpr Real kCutoff = 1;
// The box round the cylinder, and the paper's cube.
constexpr SphereBox kRoom = {{-51, -51, -1}, {51, 51, 101}, kCutoff, 5},
                    kCube = {{-50, -50, 0}, {50, 50, 100}, kCutoff, 1};

SphereArrays make_bodies(const SphereBox &box, int n, Order order)
{
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Real> speed(-1, 1);
  SphereArrays bodies;
  for (const Sphere &s : make_spheres(box, n, order)) {
    Vec3 v, omega;
    for (int k = 0; k < 3; k++) {
      v[k] = speed(random);
      omega[k] = speed(random);
    }
    bodies.add({s.x, s.y, s.z}, s.r, 1, v, omega);
  }
  return bodies;
}

struct Style {
  ContactLaw law;
  const char *name;
};

// Bytes that a step must move: position and radius of every sphere, or of every
// candidate; of one that touches v, omega and mass, and force and torque both ways; of a contact
// its spring both ways.
constexpr double kPlaceAndRadius = 4 * sizeof(Real);
double bytes_of_touching(const Style &style, double contacts)
{
  const double spring = style.law.has_history() ? 2 * sizeof(Spring) : 0;
  return contacts * ((7 + 2 * 6) * sizeof(Real) + spring);
}

void fill(BenchRow &row, const std::string &what, WallEngine &engine, const GridView &grid, int n)
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

EngineSettings engine_settings(const Style &style, Device device)
{
  EngineSettings e;
  e.device = device;
  e.law() = style.law;
  return e;
}

void measure_kept_and_anew(WallEngine &engine, const Spheres &s, const Style &style,
                           const GridView &grid, bool waits, int repeats, const char *where,
                           BenchRows &rows, BenchRow row)
{
  StepSettings step;
  step.dt = 1e-6;
  const int n_steps = waits ? 1 : 20;    // between two looks, which wait
  for (bool anew : {false, true}) {
    engine.choose(s, 0);
    row.timing = time_it(
        repeats,
        [&] {
          for (int k = 0; k < n_steps; k++) {
            if (anew) engine.choose(s, 0);
            engine.step(s, step);
          }
          engine.read_diagnostics();
        },
        n_steps);
    fill(row, std::string(style.name) + where + (anew ? ", chosen anew" : ""), engine, grid, s.n);
    // The near ones are known by their numbers.
    row.bytes =
        bytes_of_touching(style, engine.results().totals().contacts) +
        (anew ? s.n * kPlaceAndRadius : engine.n_candidates() * (kPlaceAndRadius + sizeof(int)));
    rows.add(row);
  }
}

// The arrays of a host, whose memory is the CPU's.
void measure_host(SphereArrays &bodies, const GridView &grid, const Style &style, Device device,
                  int repeats, BenchRows &rows, const BenchRow &row)
{
  const auto engine = make_engine(engine_settings(style, device));
  engine->set_grid(grid);
  measure_kept_and_anew(*engine, bodies.spheres(), style, grid, true, repeats, "", rows, row);
}

// Particles where the engine computes.
void measure_in_place(const SphereArrays &bodies, const GridView &grid, const Style &style,
                      Device device, int repeats, BenchRows &rows, const BenchRow &row)
{
  const bool cuda = device == Device::cuda;
  const EngineSettings e = engine_settings(style, device);
  const auto engine = cuda ? make_cuda_engine_in_place(e, 0, nullptr) : make_cpu_engine(e);
  engine->set_grid(grid);
  SphereArraysOn there(cuda);
  measure_kept_and_anew(*engine, there.put(bodies), style, grid, !cuda, repeats, ", in place", rows,
                        row);
}

FlatGrid grid_of(const WeldedMesh &mesh, Real length, Device device)
{
  GridSettings settings;
  settings.length = length;
  settings.cutoff = kCutoff;
  settings.for_gpu = device == Device::cuda;
  return FlatGrid(build_grid(mesh, settings, settings.for_gpu));
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  const auto number = [&](double usual) {
    return static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e5 : usual);
  };
  const int n = number(1e6), n_in_place = number(1e7);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 3 : 9;
  const Style styles[] = {{usual_law(NormalModel::hooke, false), "hooke"},
                          {usual_law(NormalModel::hertz, true), "hertz/history"}};
  for (Device device : o.devices) {
    rows.begin(device);
    for (Order order : {Order::random, Order::sorted}) {
      SphereArrays bodies = make_bodies(kRoom, n, order),
                   in_place = make_bodies(kCube, n_in_place, order);
      for (const TriangleSoup &soup : cylinders(o, 1e5)) {
        const WeldedMesh mesh = weld(soup, -1);
        BenchRow row;
        row.triangles = mesh.faces.size();
        row.order = order == Order::sorted ? "sorted" : "random";
        const FlatGrid grid = grid_of(mesh, o.length, device),
                       fine = grid_of(mesh, o.length > 0 ? o.length : 0.2, device);
        for (const Style &style : styles) {
          measure_host(bodies, grid.view(), style, device, repeats, rows, row);
          measure_in_place(in_place, fine.view(), style, device, repeats, rows, row);
        }
      }
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "step",
                   "Steps of the wall, with a CPU host's arrays and with particles in place: CSV.",
                   measure);
}
