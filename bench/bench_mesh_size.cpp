// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step against the size of the mesh: the same contacts with a cylinder of 1e2 to 1e7 triangles,
// near spheres as they were chosen, and what its grid takes of time and memory.
#include "bench.h"
#include "cylinder_bed.h"

using namespace lsdcd;

namespace {

void measure(const BenchOptions &o, BenchRows &rows)
{
  const double most = o.most_triangles > 0 ? o.most_triangles : o.quick ? 1e4 : 1.1e7;
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 3 : 9;
  for (Device device : o.devices) {
    rows.begin(device);
    const bool cuda = device == Device::cuda;
    const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : cuda ? 1e6 : 1e5);
    const int n_steps = cuda ? 20 : 1;    // between two waits for the device
    for (double size = 100; size <= most; size *= 10)
      for (bool sorted : {false, true}) {
        const EvenCylinder wall(size);
        const SphereArrays spheres = bed_spheres(wall, n, sorted);
        CylinderBed bed(wall, spheres, usual_law(NormalModel::hertz, true), device);
        BenchRow row;
        row.triangles = bed.triangles;
        row.spheres = n;
        row.order = sorted ? "sorted" : "random";
        const auto add = [&](const char *what) {
          row.what = what;
          row.facts = format(
              "cell=%.3g near=%d contacts=%lld ns_per_contact=%.2f build_ms=%.4g grid_mb=%.1f "
              "engine_mb=%.1f",
              bed.cell(), bed.n_candidates(), static_cast<long long>(bed.contacts()),
              row.timing.median_ms * 1e6 / std::max<double>(1, bed.contacts()), bed.build_ms,
              bed.grid_mb(), bed.engine_mb());
          rows.add(row);
        };
        row.timing = time_it(
            repeats, [&] { bed.steps(n_steps); }, n_steps);
        add("hertz/history, kept");
        row.timing = time_it(std::min(3, repeats), [&] {
          bed.choose();
          bed.steps(1);
        });
        add("hertz/history, chosen anew");
      }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "mesh-size", "Steps against the size of the mesh: CSV.", measure);
}
