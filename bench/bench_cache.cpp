// What a grid costs to build, to write to a cache file and to read from one.
// Prints CSV. Usage: bench_cache [repeats]
#include "bench.h"

#include "base/threads.h"
#include "grid/grid_cache.h"
#include "support/meshes.h"
#include "support/temp_dir.h"

#include <cstdlib>

using namespace lsdcd;

int main(int argc, char **argv)
{
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  std::string why;
  if (!cache_available(&why)) {
    std::fprintf(stderr, "%s\n", why.c_str());
    return 1;
  }
  const TempDir dir;
  const std::string path = dir.path("grid");
  std::puts("bench,triangles,length,reach,threads,block_mb,file_mb,repeats,build_ms,key_ms,"
            "write_ms,read_ms,read_min_ms,read_max_ms,compiler,commit");
  struct {
    int n, m;
  } const cylinders[] = {{40, 1}, {100, 49}, {400, 124}};
  for (const auto &c : cylinders) {
    const WallMesh mesh = weld(cylinder_mesh(c.n, c.m, 50, 100), -1);
    for (double length : {0.2, 0.0}) {
      GridSettings settings;
      settings.length = length;
      settings.reach = 1;
      TriangleGrid grid;
      const Timing build = time_it(2, [&] { grid = build_grid(mesh, settings); });
      std::vector<char> block(flat_bytes(grid));
      flatten(grid, block.data());
      GridKey key;
      const Timing hash = time_it(repeats, [&] { key = grid_key(mesh, settings); });
      std::size_t bytes = 0;
      const Timing write = time_it(repeats, [&] {
        bytes = write_grid_cache(path, key, grid.report, block.data(), block.size());
      });
      bool good = true;
      const Timing read = time_it(repeats, [&] {
        CachedGrid cached(path, grid_key(mesh, settings));
        std::vector<char> into(cached.block_bytes());    // a fresh block, as at start-up
        good = cached.read(into.data()) && good;
      });
      if (!good) {
        std::fprintf(stderr, "the cache cannot be read back\n");
        return 1;
      }
      std::printf("cache,%zu,%.6g,%g,%d,%.1f,%.1f,%d,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,\"%s\",%s\n",
                  mesh.faces.size(), grid.length, grid.reach, threads(), block.size() / 1e6,
                  bytes / 1e6, repeats, build.median_ms, hash.median_ms, write.median_ms,
                  read.median_ms, read.min_ms, read.max_ms, compiler(), LSDCD_COMMIT);
      std::fflush(stdout);
    }
  }
}
