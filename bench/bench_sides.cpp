// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sides of points by winding numbers, on one core, in random order: anywhere in the box of a closed
// cylinder, and within 1e-4 of its diagonal from its surface, where a ray has facets to try.
#include "bench.h"

#include "mesh/winding_number.h"
#include "support/random.h"

using namespace lsdcd;

namespace {

std::vector<Vec3> points_of(const WeldedMesh &mesh, std::size_t n, bool near)
{
  const Vec3 lo = mesh.report.lo, size = mesh.report.hi - lo;
  Random random(1);
  std::vector<Vec3> points(n);
  for (Vec3 &q : points) {
    if (near) {
      const auto &f = mesh.faces[random() % mesh.faces.size()];
      const Real a = uniform(random, 0, 1), b = uniform(random, 0, 1 - a);
      q = a * mesh.vertices[f[0]] + b * mesh.vertices[f[1]] + (1 - a - b) * mesh.vertices[f[2]];
    }
    for (int k = 0; k < 3; k++)
      q[k] = near ? q[k] + 1e-4 * norm(size) * uniform(random, -1, 1)
                  : lo[k] + size[k] * uniform(random, 0, 1);
  }
  return points;
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  const auto n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : 1e6);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 5;
  rows.begin(Device::cpu);
  for (const TriangleSoup &soup : cylinders(o, 1e6)) {
    const WeldedMesh mesh = weld(soup, -1);
    double start = clock_ms();
    const WindingNumber winding(mesh);
    start = clock_ms() - start;
    for (const bool near : {false, true}) {
      const std::vector<Vec3> points = points_of(mesh, n, near);
      std::size_t inside = 0;
      BenchRow row;
      row.what = near ? "near the surface" : "anywhere in the box";
      row.triangles = mesh.faces.size();
      row.spheres = n;
      row.order = "random";
      row.timing = time_it(repeats, [&] {
        inside = 0;
        for (const Vec3 &q : points) inside += winding.side(q) < 0;
      });
      row.facts = format("ns_each=%.0f inside=%.4f setup_ms=%.0f setup_MB=%.1f",
                         1e6 * row.timing.median_ms / static_cast<double>(n),
                         static_cast<double>(inside) / static_cast<double>(n), start,
                         1e-6 * static_cast<double>(winding.bytes()));
      rows.add(row);
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "sides", "Sides of points by winding numbers: CSV.", measure);
}
