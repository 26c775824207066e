// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How long a grid takes to build, whole and without copies to and from a device, and what
// brute force (the paper's function 1: every cell tries every triangle) would take.
#include "bench.h"
#include "brute_force.h"
#include "on_cuda.h"

#include "backend/backend_cpu.h"
#include "backend/threads.h"

using namespace lsdcd;

namespace {

constexpr double kMaxMeasured = 1e9;    // tests of a CPU's brute force, per thread
constexpr double kMaxOnCuda = 2e13;     // under a minute

double brute_ms(const TriangleGrid &grid, Device device, std::size_t n, std::size_t stride)
{
#if defined(LSDCD_HAVE_CUDA)
  if (device == Device::cuda) return cuda_brute_force_ms(grid, n, stride);
#endif
  (void) device;
  CpuBackend cpu;
  return brute_force_ms(cpu, grid, n, stride);
}

// Brute force over all cells where the limit allows it; otherwise a tenth of its tests, in cells spread
// evenly, and scaled.
void brute_row(const BenchOptions &o, BenchRows &rows, BenchRow row, const TriangleGrid &grid,
               Device device)
{
  const double cells = double(all_cells(grid)), tests = cells * grid.wall.faces.size();
  double limit = device == Device::cuda ? kMaxOnCuda : kMaxMeasured * threads();
  if (o.quick) limit /= 100;
  if (o.brute_limit > 0) limit = o.brute_limit;
  // One cell at least, however low the limit.
  const double every = tests <= limit ? 1 : std::min(10 * tests / limit, cells);
  const std::size_t stride = static_cast<std::size_t>(every), n = all_cells(grid) / stride;
  const double ms = brute_ms(grid, device, n, stride), whole = ms * cells / n;
  row.what += ", brute force";
  row.bytes = 0;
  row.timing = {whole, whole, whole, 1};
  row.facts = format("tests=%.4g tests_per_s=%.3g%s", tests, tests / whole * 1e3,
                     stride > 1 ? " estimated=yes" : "");
  rows.add(row);
}

void measure_mesh(const BenchOptions &o, BenchRows &rows, const TriangleSoup &soup, Device device)
{
  const bool on_cuda = device == Device::cuda;
  const WeldedMesh mesh = weld(soup, -1);
  int repeats = on_cuda ? 7 : 3;
  if (o.repeats > 0) repeats = o.repeats;
  std::vector<double> lengths = {0.2, 0.0};    // 0: what the fix would choose
  if (o.quick) lengths = {1};
  if (o.length > 0) lengths = {o.length};
  for (double length : lengths) {
    GridSettings settings;
    settings.length = length;
    settings.cutoff = 1;
    settings.memory_budget = std::size_t(16) << 30;
    settings.form = ListForm::packed;
    TriangleGrid grid;
    std::vector<double> inner;
    BenchRow row;
    row.timing = time_it(repeats, [&] {
      grid = TriangleGrid();
      grid = build_grid(mesh, settings, on_cuda);
      inner.push_back(1e3 * grid.report.lists.seconds);
    });
    inner.erase(inner.begin());    // the warm-up
    // Where the choice is 0.2 as well, there is nothing new to tell.
    if (length == 0 && lengths.size() > 1 && std::fabs(grid.length - lengths[0]) < 1e-9) continue;
    const GridReport &r = grid.report;
    const std::string what = length > 0 ? "given cell" : "chosen cell";
    row.what = what;
    row.triangles = mesh.faces.size();
    row.length = grid.length;
    row.bytes = double(r.bytes);    // the grid, written once
    row.facts = format("bricks=%zu cells=%zu candidates=%zu mean_list=%.3f longest=%zu tests=%.4g "
                       "grid_mb=%.1f",
                       r.lists.bricks, r.lists.cells, r.lists.entries, double(r.lists.mean),
                       r.lists.longest, double(r.lists.distance_tests), r.bytes / 1e6);
    rows.add(row);
    row.what = what + ", without copies";
    row.timing = timing_of(inner);
    rows.add(row);
    row.what = what;
    brute_row(o, rows, row, grid, device);
  }
}

void measure(const BenchOptions &options, BenchRows &rows)
{
  for (Device device : options.devices) {
    rows.begin(device);
    for (const TriangleSoup &soup : cylinders(options, 1e6))
      measure_mesh(options, rows, soup, device);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "build", "Building grids of a cylinder, cutoff 1: CSV.", measure);
}
