// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a query of many spheres against a wall costs: the paper's question, does a sphere
// touch, and the exact distance within the cutoff. No copies: spheres and answers stay on the
// device. Distances through the library on one core, beside Embree and CGAL where they are
// (near_and_far.h), and what its calls cost.
#include "bench.h"
#include "call_cost.h"
#include "near_and_far.h"
#include "peers.h"

#include "mesh/welded_mesh.h"
#include "study/sphere_query.h"
#include "study/spheres.h"

#include <memory>

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

// One device's queries and their rows.
class Queries {
 public:
  Queries(Device device, int repeats, BenchRows &rows) :
      device_(device), repeats_(repeats), rows_(rows), query_(make_sphere_query(device))
  {
  }

  // nearest 0: complete lists.
  TriangleGrid grid(const WeldedMesh &mesh, Real length, int nearest) const
  {
    GridSettings s;
    s.length = length;
    s.cutoff = kCutoff;
    s.nearest = nearest;
    s.memory_budget = std::size_t(16) << 30;
    return build_grid(mesh, s, device_ == Device::cuda);
  }

  // Grids in float are asked about spheres in float, others about spheres in double.
  void measure(const char *question, const TriangleGrid &grid, const SphereSet &set,
               const QuerySettings &settings)
  {
    give(grid, set);
    const std::size_t n = set.exact.size();
    BenchRow row;
    row.what = std::string(question) + ", " +
               (grid.nearest > 0 ? "N = " + std::to_string(grid.nearest) : "complete") + ", " +
               (grid.in_floats ? "float" : "double");
    row.triangles = grid.wall.faces.size();
    row.spheres = n;
    row.length = grid.length;
    row.order = name_of(set.order);
    row.bytes = bytes_of(n, grid.in_floats, settings.distance);
    row.timing = time(settings);
    row.facts = format("million_per_s=%.4g ", double(n) / row.timing.median_ms / 1e3) +
                facts(grid, query_->status());
    rows_.add(row);
  }

 private:
  Timing time(const QuerySettings &settings)
  {
    if (device_ == Device::cpu) return time_it(repeats_, [&] { query_->run(settings); });
    const QueryTiming t = query_->time(settings, repeats_);
    return {t.median_ms, t.min_ms, t.max_ms, t.repeats};
  }

  // Spheres in, a byte and maybe a distance out.
  static double bytes_of(std::size_t n, bool in_floats, bool distance)
  {
    const double bytes = double(n) * ((in_floats ? sizeof(FloatSphere) : sizeof(Sphere)) + 1);
    return bytes + (distance ? double(n) * (in_floats ? sizeof(float) : sizeof(Real)) : 0);
  }

  void give(const TriangleGrid &grid, const SphereSet &set)
  {
    query_->set_grid(grid);
    if (grid.in_floats)
      query_->set_spheres(set.rounded.data(), set.rounded.size());
    else
      query_->set_spheres(set.exact.data(), set.exact.size());
  }

  std::string facts(const TriangleGrid &grid, const std::vector<std::uint8_t> &status)
  {
    std::size_t touching = 0, near = 0, entries = 0;
    for (std::uint8_t s : status) touching += (s & kTouching) > 0;
    QuerySettings read;
    read.distance = false;
    read.read = true;
    query_->run(read);
    for (std::uint32_t n : query_->read()) {
      near += n > 0;
      entries += n;
    }
    return format("near=%zu touching=%zu entries=%.3f grid_mb=%.1f", near, touching,
                  near > 0 ? double(entries) / near : 0, flat_bytes(grid) / 1e6);
  }

  Device device_;
  int repeats_;
  BenchRows &rows_;
  std::unique_ptr<SphereQuery> query_;
};

// The paper's frame: a cylinder of 160 triangles, N = 1, 2, 3 and complete lists.
void measure_status(const BenchOptions &o, Queries &queries)
{
  const WeldedMesh mesh = weld(cylinders(o, 1e6)[0], -1);
  const Real length = o.length > 0 ? o.length : 0.2;
  std::vector<double> sizes = {1e7, 6e7};
  if (o.quick) sizes = {1e5};
  if (o.spheres > 0) sizes = {o.spheres};
  QuerySettings settings;
  settings.distance = false;
  for (double n : sizes)
    for (Order order : {Order::random, Order::sorted}) {
      const SphereSet set = make_set(static_cast<std::size_t>(n), order, false);
      for (int nearest : {1, 2, 3, 0}) {
        TriangleGrid grid = queries.grid(mesh, length, nearest);
        if (nearest == 0) queries.measure("status", grid, set, settings);
        add_brick_records(grid);
        queries.measure("status", grid, set, settings);
      }
    }
}

// The distance of every sphere of the largest radius, complete lists.
void measure_distance(const BenchOptions &o, Queries &queries)
{
  const std::size_t n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres : o.quick ? 1e5 : 1e7);
  const SphereSet random = make_set(n, Order::random, true),
                  sorted = make_set(n, Order::sorted, true);
  for (const TriangleSoup &soup : cylinders(o, 1e6)) {
    const Real length = o.length > 0 ? o.length : 0.2;
    TriangleGrid grid = queries.grid(weld(soup, -1), length, 0);
    for (bool in_floats : {false, true}) {
      if (in_floats) add_brick_records(grid);
      for (const SphereSet *set : {&random, &sorted})
        queries.measure("distance", grid, *set, QuerySettings());
    }
  }
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
    Queries queries(device, repeats, rows);
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
                   "Status and distance of many spheres against a cylinder: CSV.", measure);
}
