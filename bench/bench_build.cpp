// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How long a grid takes to build with the cells that the fix chooses, copies from and to a device included, and to be written to a
// cache file and read from it.
#include "bench.h"

#include "base/input_error.h"
#include "grid/cache/grid_cache.h"
#include "mesh/welded_mesh.h"
#include "support/temp_dir.h"

using namespace lsdcd;

namespace {

// The same whatever device builds.
void measure_cache(const WeldedMesh &mesh, const StepGridSettings &settings,
                   const TriangleGrid &grid, int repeats, BenchRow row, BenchRows &rows)
{
  const TempDir dir;
  const std::string path = dir.path("grid");
  std::vector<char> block(flat_bytes(grid));
  flatten(grid, block.data());
  std::size_t bytes = 0;
  row.what = "write";
  row.timing = time_it(repeats, [&] {
    bytes =
        write_grid_cache(path, grid_key(mesh, settings), grid.report, block.data(), block.size());
  });
  row.bytes = double(block.size() + bytes);
  rows.add(row);
  bool good = true;
  row.what = "read";
  row.timing = time_it(repeats, [&] {
    CachedGrid cached(path, grid_key(mesh, settings));
    std::vector<char> into(cached.block_bytes());    // a fresh block, as at start-up
    good = cached.read(into.data()) && good;
  });
  if (!good) throw InputError("the cache cannot be read back");
  rows.add(row);
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  for (Device device : o.devices) {
    rows.begin(device);
    const bool on_cuda = device == Device::cuda;
    const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 2 : on_cuda ? 7 : 5;
    for (const TriangleSoup &soup : cylinders(o, 1e5)) {
      const WeldedMesh mesh = weld(soup, -1);
      StepGridSettings settings;
      settings.length = o.length;
      settings.cutoff = 1;
      StepGrid grid;
      BenchRow row;
      row.what = "chosen cell";
      row.timing = time_it(repeats, [&] {
        grid = StepGrid();
        grid = build_grid(mesh, settings, on_cuda);
      });
      row.triangles = mesh.faces.size();
      row.length = grid.length;
      row.bytes = double(grid.report.bytes);    // the grid, written once
      rows.add(row);
      if (!on_cuda) measure_cache(mesh, settings, grid, repeats, row, rows);
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "build",
                   "Grids of a cylinder, built, written and read, cutoff 1: CSV.", measure);
}
