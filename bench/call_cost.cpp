// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "call_cost.h"

#include "lsdcd.hpp"
#include "support/meshes.h"

#include <cmath>
#include <random>
#include <stdexcept>

namespace lsdcd {

namespace {

Mesh mesh_of(const TriangleSoup &soup)
{
  std::vector<double> corners;
  for (const Vec3 &p : soup.corners) corners.insert(corners.end(), {p.x, p.y, p.z});
  return Mesh(corners);
}

// The time of one call, from that of so many that a clock can measure it.
template <class F>
Timing time_call(int repeats, std::size_t calls, const F &call)
{
  Timing t = time_it(repeats, [&] {
    for (std::size_t k = 0; k < calls; k++) call();
  });
  for (double *ms : {&t.median_ms, &t.min_ms, &t.max_ms}) *ms /= double(calls);
  return t;
}

// About the axis of the paper's cylinder, so far from it.
std::vector<double> ring(std::size_t n, double least, double most)
{
  std::mt19937 r(1);
  std::uniform_real_distribution<double> from_axis(least, most), angle(0, 2 * kPi), height(10, 90);
  std::vector<double> points;
  for (std::size_t i = 0; i < n; i++) {
    const double d = from_axis(r), a = angle(r);
    points.insert(points.end(), {d * std::cos(a), d * std::sin(a), height(r)});
  }
  return points;
}

}    // namespace

void measure_calls(const BenchOptions &options, BenchRows &rows)
{
  const TriangleSoup cylinder = cylinders(options, 1e6)[0];
  const Mesh wall = mesh_of(cylinder);
  const Grid grid(wall, 1);
  const int repeats = options.repeats > 0 ? options.repeats : options.quick ? 3 : 21;
  const std::size_t points = options.quick ? 1000 : 1000000;    // in all calls of a repeat
  BenchRow row;
  row.triangles = cylinder.n_triangles();
  row.length = grid.facts().cell;
  row.order = "random";
  for (const bool near : {true, false})
    for (const std::size_t n : {1, 16, 64, 256, 100000}) {
      const std::vector<double> at = near ? ring(n, 49.5, 49.9) : ring(n, 10, 40);
      std::vector<double> distance(n);
      Query<double> q(at.data(), n);
      q.threads = 1;
      q.distance = distance.data();
      row.what = near ? "call, near" : "call, far";
      row.spheres = n;
      row.timing = time_call(repeats, std::max<std::size_t>(1, points / n), [&] { grid.query(q); });
      rows.add(row);
    }
  Body body(wall, mesh_of(box_mesh({-5, -5, -5}, {5, 5, 5})));
  const double at[3] = {0, 0, 50}, turned[4] = {0.6, 0.8, 0, 0};
  row.what = "call, a pose of a box of 12 triangles clear of the wall";
  row.spheres = 0;
  row.length = body.facts().cell;
  row.timing = time_call(repeats, std::max<std::size_t>(1, points / 10), [&] {
    if (body.collides(at, turned, 1)) throw std::runtime_error("the box touches the wall");
  });
  rows.add(row);
}

}    // namespace lsdcd
