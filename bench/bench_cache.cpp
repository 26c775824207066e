// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of building a grid, of writing it to a cache file and of reading it from one.
#include "bench.h"

#include "base/input_error.h"
#include "grid/cache/grid_cache.h"
#include "mesh/welded_mesh.h"
#include "support/temp_dir.h"

using namespace lsdcd;

namespace {

void measure_grid(const WeldedMesh &mesh, const GridSettings &settings, int repeats,
                  BenchRows &rows)
{
  const TempDir dir;
  const std::string path = dir.path("grid");
  TriangleGrid grid;
  BenchRow row;
  row.timing = time_it(std::min(repeats, 2), [&] { grid = build_grid(mesh, settings); });
  row.triangles = mesh.faces.size();
  row.length = grid.length;
  std::vector<char> block(flat_bytes(grid));
  flatten(grid, block.data());
  row.what = "build";
  row.bytes = double(block.size());
  row.facts = format("block_mb=%.1f", block.size() / 1e6);
  rows.add(row);

  std::size_t bytes = 0;
  row.timing = time_it(repeats, [&] {
    bytes =
        write_grid_cache(path, grid_key(mesh, settings), grid.report, block.data(), block.size());
  });
  row.what = "write";
  row.bytes = double(block.size() + bytes);
  row.facts = format("block_mb=%.1f file_mb=%.1f", block.size() / 1e6, bytes / 1e6);
  rows.add(row);

  bool good = true;
  row.timing = time_it(repeats, [&] {
    CachedGrid cached(path, grid_key(mesh, settings));
    std::vector<char> into(cached.block_bytes());    // a fresh block, as at start-up
    good = cached.read(into.data()) && good;
  });
  if (!good) throw InputError("the cache cannot be read back");
  row.what = "read";
  rows.add(row);
}

// The same whatever device builds: on the CPU alone.
void measure(const BenchOptions &o, BenchRows &rows)
{
  if (std::find(o.devices.begin(), o.devices.end(), Device::cpu) == o.devices.end()) return;
  rows.begin(Device::cpu);
  std::vector<double> lengths = {0.2, 0.0};    // 0: what the fix would choose
  if (o.quick) lengths = {1};
  if (o.length > 0) lengths = {o.length};
  for (const TriangleSoup &soup : cylinders(o, 1e5)) {
    const WeldedMesh mesh = weld(soup, -1);
    for (double length : lengths) {
      GridSettings settings;
      settings.length = length;
      settings.cutoff = 1;
      measure_grid(mesh, settings, o.repeats > 0 ? o.repeats : o.quick ? 2 : 5, rows);
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "cache", "A grid's cache file, written and read: CSV.", measure);
}
