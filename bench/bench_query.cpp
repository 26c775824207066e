// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The time of the library for many spheres against a wall: the paper's question, does a sphere
// touch, and the exact distance within the cutoff. No copies: spheres and answers stay on the
// device. Distances on one core stand beside Embree and CGAL where they are
// (near_and_far.h), and so does the cost of calls of the library.
#include "bench.h"
#include "call_cost.h"
#include "library_query.h"
#include "near_and_far.h"
#include "peers.h"

#include "study/spheres.h"

using namespace lsdcd;

namespace {

constexpr Real kCutoff = 1;
const SphereBox kCube = {{-50, -50, 0}, {50, 50, 100}, kCutoff, 1};

const char *name_of(Order order)
{
  return order == Order::random ? "random" : "sorted";
}

struct SphereSet {
  Order order;
  std::vector<Sphere> exact;
  std::vector<FloatSphere> rounded;
};

// Radii up to the cutoff, or all equal to it.
SphereSet make_set(std::size_t n, Order order, bool largest)
{
  SphereSet set;
  set.order = order;
  set.exact = make_spheres(kCube, n, order);
  set.rounded.reserve(n);
  if (largest)
    for (Sphere &s : set.exact) s.r = kCutoff;
  for (const Sphere &s : set.exact)
    set.rounded.push_back({static_cast<float>(s.x), static_cast<float>(s.y),
                           static_cast<float>(s.z), static_cast<float>(s.r)});
  return set;
}

// A device's queries and their rows.
struct Queries {
  Device device;
  int repeats;
  BenchRows &rows;

  // Grids in float are asked about spheres in float, others about spheres in double.
  void measure(const TriangleSoup &mesh, LibraryGrid grid,
               std::initializer_list<const SphereSet *> sets, bool distance)
  {
    grid.on_cuda = device == Device::cuda;
    LibraryQuery query(mesh, grid);
    for (const SphereSet *set : sets) {
      const std::size_t n = set->exact.size();
      BenchRow row;
      row.what = std::string(distance ? "distance" : "status") + ", " +
                 (grid.nearest > 0 ? "N = " + std::to_string(grid.nearest) : "complete") + ", " +
                 (grid.in_floats ? "float" : "double");
      row.triangles = mesh.n_triangles();
      row.spheres = n;
      row.length = grid.cell;
      row.order = name_of(set->order);
      row.bytes = bytes_of(n, grid.in_floats, distance);
      row.timing = grid.in_floats ? query.time_spheres(set->rounded.data(), n, distance, repeats)
                                  : query.time_spheres(set->exact.data(), n, distance, repeats);
      std::size_t touching = 0;
      for (std::uint8_t status : query.status()) touching += (status & LSDCD_FOUND) > 0;
      row.facts =
          format("million_per_s=%.4g touching=%zu grid_mb=%.1f",
                 double(n) / row.timing.median_ms / 1e3, touching, query.grid_bytes() / 1e6);
      rows.add(row);
    }
  }

 private:
  // Spheres in, a byte and maybe a distance out.
  static double bytes_of(std::size_t n, bool in_floats, bool distance)
  {
    const double bytes = double(n) * ((in_floats ? sizeof(FloatSphere) : sizeof(Sphere)) + 1);
    return bytes + (distance ? double(n) * (in_floats ? sizeof(float) : sizeof(Real)) : 0);
  }
};

// The paper's frame: a cylinder of 160 triangles, N = 1, 2, 3 and complete lists.
void measure_status(const BenchOptions &o, Queries &queries)
{
  const TriangleSoup mesh = cylinders(o, 1e6)[0];
  const Real length = o.length > 0 ? o.length : 0.2;
  std::vector<double> sizes = {1e7, 6e7};
  if (o.quick) sizes = {1e5};
  if (o.spheres > 0) sizes = {o.spheres};
  for (double n : sizes)
    for (Order order : {Order::random, Order::sorted}) {
      const SphereSet set = make_set(static_cast<std::size_t>(n), order, false);
      for (int nearest : {1, 2, 3, 0})
        for (bool in_floats : {false, true})
          if (nearest == 0 || in_floats)
            queries.measure(mesh, {kCutoff, length, nearest, in_floats}, {&set}, false);
    }
}

// The distance of every sphere of the largest radius, complete lists.
void measure_distance(const BenchOptions &o, Queries &queries)
{
  const std::size_t n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres : o.quick ? 1e5 : 1e7);
  const SphereSet random = make_set(n, Order::random, true),
                  sorted = make_set(n, Order::sorted, true);
  for (const TriangleSoup &mesh : cylinders(o, 1e6))
    for (bool in_floats : {false, true})
      queries.measure(mesh, {kCutoff, o.length > 0 ? o.length : 0.2, 0, in_floats},
                      {&random, &sorted}, true);
}

void measure(const BenchOptions &options, BenchRows &rows)
{
  for (const Peer &peer : {embree(), cgal()})
    if (!peer.build)
      std::fprintf(stderr, "skipped: %s (%s is not installed)\n", peer.name.c_str(), peer.package);
  for (Device device : options.devices) {
    rows.begin(device);
    int repeats = device == Device::cuda ? 21 : 5;
    if (options.quick) repeats = 3;
    if (options.repeats > 0) repeats = options.repeats;
    Queries queries = {device, repeats, rows};
    const auto wanted = [&](const char *part) {
      return options.part.empty() || options.part == part;
    };
    if (wanted("status")) measure_status(options, queries);
    if (wanted("distance")) measure_distance(options, queries);
    if (wanted("near-and-far") && device == Device::cpu) measure_near_and_far(options, rows);
#if defined(LSDCD_HAVE_CUDA)
    if (wanted("tree") && device == Device::cuda) measure_tree_on_gpu(options, rows);
#endif
    if (wanted("calls") && device == Device::cpu) measure_calls(options, rows);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "query",
                   "Status and distance of many spheres against a cylinder, by the library: CSV.",
                   measure);
}
