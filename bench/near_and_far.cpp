// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "near_and_far.h"

#include "backend/threads.h"
#include "geometry/closest_point.h"
#include "library_query.h"
#include "mesh/welded_mesh.h"
#include "on_cuda.h"
#include "peers.h"
#include "study/spheres.h"

#include <cmath>
#include <functional>
#include <memory>

namespace lsdcd {

namespace {

constexpr std::uint64_t kSeed = 1;

// A sphere of radius 1 in 4 m (m - 1) triangles: 2 m segments round, m along.
TriangleSoup sphere_mesh(int m)
{
  TriangleSoup soup;
  const auto at = [&](int along, int round) {
    const double down = kPi * along / m, angle = kPi * (round % (2 * m)) / m;
    const double across = along % m == 0 ? 0 : std::sin(down);
    return Vec3{across * std::cos(angle), across * std::sin(angle), std::cos(down)};
  };
  for (int i = 0; i < m; i++)
    for (int j = 0; j < 2 * m; j++) {
      const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (i + 1 < m) soup.corners.insert(soup.corners.end(), {a, b, c});
      if (i > 0) soup.corners.insert(soup.corners.end(), {a, c, d});
    }
  return soup;
}

// Points of the surface, uniform by area, moved along the normal by less than the radius to
// either side: all are found.
std::vector<Sphere> near_points(const TriangleSoup &mesh, Real radius, std::size_t n)
{
  std::vector<double> area_up_to;
  double area = 0;
  for (std::size_t t = 0; t < mesh.n_triangles(); t++) {
    const Vec3 *corner = &mesh.corners[3 * t];
    area += norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
    area_up_to.push_back(area);
  }
  std::vector<Sphere> points;
  for (std::uint64_t i = 0; i < n; i++) {
    const auto random = [&](std::uint64_t k) { return uniform(kSeed, 4 * i + k); };
    const auto place =
        std::lower_bound(area_up_to.begin(), area_up_to.end(), random(0) * area_up_to.back());
    const Vec3 *corner = &mesh.corners[3 * (place - area_up_to.begin())];
    Real u = random(1), v = random(2);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vec3 side = corner[1] - corner[0], other = corner[2] - corner[0];
    const Vec3 normal = (1 / norm(cross(side, other))) * cross(side, other);
    const Vec3 p =
        corner[0] + u * side + v * other + Real(0.99) * radius * (2 * random(3) - 1) * normal;
    points.push_back({p.x, p.y, p.z, radius});
  }
  return points;
}

void sort(std::vector<Sphere> &points, const SphereBox &box)
{
  std::vector<std::pair<std::uint32_t, Sphere>> placed;
  for (const Sphere &s : points) placed.push_back({number_on_curve(box, s.centre()), s});
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  for (std::size_t i = 0; i < points.size(); i++) points[i] = placed[i].second;
}

// The points for a slow method: runs of neighbours in the order, spread over all of it.
std::vector<std::size_t> sample(std::size_t n, double most)
{
  constexpr std::size_t kRun = 1000;
  const std::size_t step =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(double(n) / most)));
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < n; i++)
    if (i / kRun % step == 0) places.push_back(i);
  return places;
}

// One way to get distances.
struct Way {
  std::string name, setup;    // facts of its set-up
  double most, cell;
  std::function<Timing(const std::vector<Sphere> &)> time;    // one run after one to warm up
  std::function<std::vector<double>()> distances;             // of the last run
};

Way library_way(const TriangleSoup &mesh, Real radius, bool in_floats)
{
  const double start = clock_ms();
  const auto library = std::make_shared<LibraryQuery>(mesh, LibraryGrid{radius, 0, 0, in_floats});
  const double seconds = (clock_ms() - start) / 1e3;
  const auto time = [=](const std::vector<Sphere> &points) {
    if (!in_floats) return library->time(points.data(), points.size());
    std::vector<FloatSphere> rounded;
    for (const Sphere &s : points)
      rounded.push_back({static_cast<float>(s.x), static_cast<float>(s.y), static_cast<float>(s.z),
                         static_cast<float>(s.r)});
    return library->time(rounded.data(), rounded.size());
  };
  return {in_floats ? "library, float" : "library, double",
          format("setup_s=%.4g grid_mb=%.1f", seconds, library->grid_bytes() / 1e6),
          HUGE_VAL,
          library->cell(),
          time,
          [=] { return library->distances(); }};
}

Way peer_way(const Peer &peer, const TriangleSoup &mesh)
{
  const double start = clock_ms();
  const PeerQuery query = peer.build(mesh);
  const double seconds = (clock_ms() - start) / 1e3;
  const auto distance = std::make_shared<std::vector<double>>();
  const auto time = [=](const std::vector<Sphere> &points) {
    distance->resize(points.size());
    return time_it(1, [&] { query(points.data(), points.size(), distance->data()); });
  };
  return {peer.name, format("setup_s=%.4g", seconds), peer.most, 0,
          time,      [=] { return *distance; }};
}

// Points inside of the sphere and outside, up to two radii from its middle along each axis.
std::vector<Sphere> any_points(std::size_t n)
{
  const SphereBox box = {{-2, -2, -2}, {2, 2, 2}, 1, kSeed};
  std::vector<Sphere> points(n);
  for (std::uint64_t i = 0; i < n; i++) {
    points[i] = box.sphere(i);
    points[i].r = kAnyDistance;
  }
  return points;
}

// Points of the box that a way does not find.
std::vector<Sphere> far_points(const Way &way, const SphereBox &box, std::size_t n)
{
  std::vector<Sphere> points;
  for (std::uint64_t i = 0; points.size() < n; i += n) {
    std::vector<Sphere> some(n);
    for (std::size_t k = 0; k < n; k++) {
      some[k] = box.sphere(i + k);
      some[k].r = box.largest;
    }
    way.time(some);
    const std::vector<double> distance = way.distances();
    for (std::size_t k = 0; k < n && points.size() < n; k++)
      if (!std::isfinite(distance[k])) points.push_back(some[k]);
  }
  return points;
}

// All ways in turn, `repeats` times, so that what slows the machine slows all of them.
void compare(const std::vector<Way> &ways, const std::vector<Sphere> &points, int repeats,
             BenchRow row, const std::string &place, BenchRows &rows)
{
  std::vector<std::vector<double>> ms(ways.size());
  std::vector<std::string> facts(ways.size());
  std::vector<std::size_t> asked(ways.size());
  std::vector<double> ours;
  for (int k = 0; k < repeats; k++)
    for (std::size_t w = 0; w < ways.size(); w++) {
      const std::vector<std::size_t> places = sample(points.size(), ways[w].most);
      std::vector<Sphere> some;
      for (const std::size_t i : places) some.push_back(points[i]);
      ms[w].push_back(ways[w].time(some).median_ms);
      const std::vector<double> theirs = ways[w].distances();
      if (w == 0) ours = theirs;
      std::size_t found = 0, by_one = 0;
      double most = 0;
      for (std::size_t i = 0; i < places.size(); i++) {
        const double a = ours[places[i]], b = theirs[i];
        found += std::isfinite(b);
        by_one += std::isfinite(a) != std::isfinite(b);
        if (std::isfinite(a) && std::isfinite(b)) most = std::max(most, std::fabs(a - b));
      }
      asked[w] = places.size();
      facts[w] = format("found=%zu found_by_one=%zu largest_difference=%.2g ", found, by_one, most);
    }
  for (std::size_t w = 0; w < ways.size(); w++) {
    row.what = place + ", " + ways[w].name;
    row.spheres = asked[w];
    row.length = ways[w].cell;
    row.timing = timing_of(ms[w]);
    row.facts = format("ns_per_point=%.4g ", row.timing.median_ms * 1e6 / double(asked[w])) +
                facts[w] + ways[w].setup;
    rows.add(row);
  }
}

constexpr int kMeshes[] = {16, 50, 158, 500};

Real near_radius()
{
  return 0.005 * std::sqrt(12.);    // 0.5 % of the diagonal
}

}    // namespace

void measure_near_and_far(const BenchOptions &o, BenchRows &rows)
{
  const OneThread one;
  rows.begin(Device::cpu);
  const std::size_t n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : 1e6);
  const double most = o.most_triangles > 0 ? o.most_triangles : o.quick ? 1e4 : 1e6;
  for (const int m : kMeshes) {
    if (4. * m * (m - 1) > most) continue;
    const TriangleSoup mesh = sphere_mesh(m);
    const Real radius = near_radius();
    const SphereBox box = {{-1 - radius, -1 - radius, -1 - radius},
                           {1 + radius, 1 + radius, 1 + radius},
                           radius,
                           kSeed};
    std::vector<Way> ways = {library_way(mesh, radius, false), library_way(mesh, radius, true)};
    for (const Peer &peer : {embree(), cgal()})
      if (peer.build) ways.push_back(peer_way(peer, mesh));
    for (const bool near : {true, false}) {
      std::vector<Sphere> points =
          near ? near_points(mesh, radius, n) : far_points(ways[0], box, n);
      BenchRow row;
      row.triangles = mesh.n_triangles();
      for (const char *order : {"random", "sorted"}) {
        if (order[0] == 's') sort(points, box);
        row.order = order;
        compare(ways, points, o.repeats > 0 ? o.repeats : 3, row, near ? "near" : "far", rows);
      }
    }
    // At any distance: without a cutoff, and cells in float have one.
    ways.erase(ways.begin(), ways.begin() + 2);
    ways.insert(ways.begin(), library_way(mesh, 0, false));
    std::vector<Sphere> points = any_points(std::max<std::size_t>(n / 20, 1000));
    BenchRow row;
    row.triangles = mesh.n_triangles();
    for (const char *order : {"random", "sorted"}) {
      if (order[0] == 's') sort(points, {{-2, -2, -2}, {2, 2, 2}, 1, kSeed});
      row.order = order;
      compare(ways, points, o.repeats > 0 ? o.repeats : 3, row, "any", rows);
    }
  }
}

#if defined(LSDCD_HAVE_CUDA)
void measure_tree_on_gpu(const BenchOptions &o, BenchRows &rows)
{
  const std::size_t n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres : o.quick ? 1e5 : 1e7);
  for (const int m : kMeshes) {
    const TriangleSoup soup = sphere_mesh(m);
    const WeldedMesh mesh = weld(soup, -1);
    const TriangleTable names(mesh);
    const TriangleTree tree(mesh, names);
    for (const bool near : {true, false}) {
      std::vector<Sphere> points = near ? near_points(soup, near_radius(), n) : any_points(n);
      BenchRow row;
      row.triangles = soup.n_triangles();
      row.spheres = n;
      for (const char *order : {"random", "sorted"}) {
        if (order[0] == 's') sort(points, {{-2, -2, -2}, {2, 2, 2}, 1, kSeed});
        row.order = order;
        row.what = near ? "near, tree" : "any, tree";
        std::vector<double> distance;
        row.timing = timing_of(cuda_tree_ms(tree, points, o.repeats > 0 ? o.repeats : 5, distance));
        std::size_t differ = 0;
        const std::size_t step = std::max<std::size_t>(1, n / 10000);
        for (std::size_t i = 0; i < n; i += step) {
          const TreeAnswer a = tree.nearest(points[i].centre(), points[i].r, kNoPrimitive);
          differ += distance[i] != (a.found() ? a.distance : HUGE_VAL);
        }
        row.facts = format("ns_per_point=%.4g differ_from_cpu=%zu tree_mb=%.1f",
                           row.timing.median_ms * 1e6 / double(n), differ, tree.bytes() / 1e6);
        rows.add(row);
      }
    }
  }
}
#endif

}    // namespace lsdcd
