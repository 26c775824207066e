// How long a grid takes to build, on each backend, and what brute force (the
// paper's function 1: every cell tests every feature) would do instead.
// Prints CSV. Usage: bench_build [repeats]
#include "bench.h"

#include "contact/closest_point.h"
#include "engine/wall_engine.h"
#include "support/meshes.h"

#include <cmath>
#include <cstdlib>

using namespace lsdcd;

namespace {

// Brute force over a sample of cells, scaled to all of them; returns milliseconds.
double brute_force_ms(const TriangleGrid &grid)
{
  const GridView view = grid.view();
  const double n_cells =
      double(grid.n_bricks[0]) * grid.n_bricks[1] * grid.n_bricks[2] * kBrickCells;
  const std::size_t n_features = grid.wall.contact_features.size();
  const std::size_t sample = std::max<std::size_t>(1, 40000000 / n_features);
  const Real h = 0.5 * std::sqrt(3.0) * grid.length;
  std::size_t found = 0;
  const Timing t = time_it(1, [&] {
    for (std::size_t i = 0; i < sample; i++) {
      const Vec3 c = grid.origin +
                     grid.length * Vec3{double(i % 97), double(i * 31 % 89), double(i * 17 % 83)};
      for (FeatureCode f : grid.wall.contact_features) found += foot_on(view.wall, f, c, h).found;
    }
  });
  if (found == ~std::size_t(0)) std::puts("");    // keeps the loop
  return t.median_ms * n_cells / sample;
}

}    // namespace

int main(int argc, char **argv)
{
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  std::string why;
  const bool cuda = cuda_available(&why);
  if (!cuda) std::fprintf(stderr, "CUDA rows are left out: %s\n", why.c_str());
  std::puts("bench,triangles,length,reach,device,bricks,cells,candidates,mean_list,longest_list,"
            "bytes,distance_tests,brute_force_tests,repeats,median_ms,min_ms,max_ms,build_ms,"
            "brute_force_ms_estimated,compiler,commit");
  struct {
    int n, m;
  } const cylinders[] = {{40, 1}, {100, 49}, {400, 124}, {2000, 249}};
  for (const auto &c : cylinders) {
    const WallMesh mesh = weld(cylinder_mesh(c.n, c.m, 50, 100), -1);
    for (double length : {0.2, 0.0})
      for (bool on_cuda : {false, true}) {
        if (on_cuda && !cuda) continue;
        GridSettings settings;
        settings.length = length;
        settings.reach = 1;
        settings.memory_budget = std::size_t(16) << 30;
        TriangleGrid grid;
        std::vector<double> inner;    // without copies to and from the device
        const Timing t = time_it(on_cuda ? repeats : std::min(repeats, 2), [&] {
          grid = build_grid(mesh, settings, on_cuda);
          inner.push_back(1e3 * grid.report.lists.seconds);
        });
        inner.erase(inner.begin());    // the warm-up
        std::sort(inner.begin(), inner.end());
        const GridReport &r = grid.report;
        const double cells =
            double(grid.n_bricks[0]) * grid.n_bricks[1] * grid.n_bricks[2] * kBrickCells;
        std::printf(
            "build,%zu,%.6g,%g,\"%s\",%zu,%zu,%zu,%.3f,%zu,%zu,%zu,%.4g,%d,%.3f,%.3f,%.3f,%.3f,"
            "%.4g,\"%s\",%s\n",
            mesh.faces.size(), grid.length, grid.reach, r.device.c_str(), r.lists.bricks,
            r.lists.cells, r.lists.candidates, r.lists.mean, r.lists.longest, r.bytes,
            r.lists.distance_tests, cells * grid.wall.contact_features.size(), t.repeats,
            t.median_ms, t.min_ms, t.max_ms, inner[inner.size() / 2],
            on_cuda ? 0.0 : brute_force_ms(grid), compiler(), LSDCD_COMMIT);
        std::fflush(stdout);
      }
  }
}
