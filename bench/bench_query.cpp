// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points near a mesh, of points far from it and of points anywhere: by the library on one core, beside Embree and
// CGAL where these are, and on a GPU, where points and answers stay.
#include "bench.h"
#include "on_cuda.h"
#include "peers.h"

#include "backend/threads.h"
#include "geometry/closest_point.h"
#include "lsdcd.hpp"
#include "study/spheres.h"

#include <cmath>
#include <memory>

using namespace lsdcd;

namespace {

constexpr std::uint64_t kSeed = 1;
constexpr SphereBox kAround = {{-2, -2, -2}, {2, 2, 2}, 1, kSeed};    // of points anywhere
const Real kNear = 0.005 * std::sqrt(12.);                            // 0.5 % of the diagonal

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

// Points of the surface, uniform by area, moved along the normal by less than the cutoff to
// either side: all are found.
std::vector<Sphere> near_points(const TriangleSoup &mesh, std::size_t n)
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
        corner[0] + u * side + v * other + Real(0.99) * kNear * (2 * random(3) - 1) * normal;
    points.push_back({p.x, p.y, p.z, kNear});
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

// One way to get distances. A point has the cutoff as its radius.
struct Way {
  std::string name, setup;    // facts of its set-up
  double most;                // points in a run: more would take long
  // Returns the milliseconds of a run after one to warm up. A distance is infinite where nothing is nearer than the cutoff.
  std::function<double(const std::vector<Sphere> &, std::vector<double> &)> time;
};

Mesh mesh_of(const TriangleSoup &soup)
{
  std::vector<double> corners;
  for (const Vec3 &p : soup.corners) corners.insert(corners.end(), {p.x, p.y, p.z});
  return Mesh(corners);
}

Way library_way(const TriangleSoup &soup, Device device)
{
  const Mesh mesh = mesh_of(soup);
  const double start = clock_ms();
  const auto grid = std::make_shared<Grid>(mesh);
  const auto time = [=](const std::vector<Sphere> &points, std::vector<double> &distance) {
    Query<double> q(&points[0].x, points.size());
    q.points_row = 4;
    q.points_column = 1;
    q.radius = points[0].r < kAnyDistance ? points[0].r : 0;
    q.distance = distance.data();
#if defined(LSDCD_HAVE_CUDA)
    if (device == Device::cuda) return cuda_query_ms(grid->get(), q);
#endif
    return time_it(1, [&] { grid->query(q); }).median_ms;
  };
  return {
      "library, double",
      format("setup_s=%.4g grid_mb=%.1f", (clock_ms() - start) / 1e3, grid->facts().bytes / 1e6),
      HUGE_VAL, time};
}

Way peer_way(const Peer &peer, const TriangleSoup &mesh)
{
  const double start = clock_ms();
  const PeerQuery query = peer.build(mesh);
  const auto time = [=](const std::vector<Sphere> &points, std::vector<double> &distance) {
    return time_it(1, [&] { query(points.data(), points.size(), distance.data()); }).median_ms;
  };
  return {peer.name, format("setup_s=%.4g", (clock_ms() - start) / 1e3), peer.most, time};
}

// Points inside of the sphere and outside, up to two radii from its middle along each axis.
std::vector<Sphere> any_points(std::size_t n)
{
  std::vector<Sphere> points(n);
  for (std::uint64_t i = 0; i < n; i++) {
    points[i] = kAround.sphere(i);
    points[i].r = kAnyDistance;
  }
  return points;
}

// Points of the box that a way does not find.
std::vector<Sphere> far_points(const Way &way, const SphereBox &box, std::size_t n)
{
  std::vector<Sphere> points, some(n);
  std::vector<double> distance(n);
  for (std::uint64_t i = 0; points.size() < n; i += n) {
    for (std::size_t k = 0; k < n; k++) {
      some[k] = box.sphere(i + k);
      some[k].r = box.largest;
    }
    way.time(some, distance);
    for (std::size_t k = 0; k < n && points.size() < n; k++)
      if (!std::isfinite(distance[k])) points.push_back(some[k]);
  }
  return points;
}

// All ways in turn, `repeats` times, so that what slows the machine slows all of them.
void compare(const std::vector<Way> &ways, const std::vector<Sphere> &points, int repeats,
             BenchRow row, const std::string &place, BenchRows &rows)
{
  struct Found {
    std::vector<double> ms;
    std::size_t asked = 0;
    std::string facts;
  };
  std::vector<Found> of_ways(ways.size());
  std::vector<double> ours;
  for (int k = 0; k < repeats; k++)
    for (std::size_t w = 0; w < ways.size(); w++) {
      const std::vector<std::size_t> places = sample(points.size(), ways[w].most);
      std::vector<Sphere> some;
      for (const std::size_t i : places) some.push_back(points[i]);
      std::vector<double> theirs(some.size());
      of_ways[w].ms.push_back(ways[w].time(some, theirs));
      if (w == 0) ours = theirs;
      std::size_t found = 0, by_one = 0;
      double most = 0;
      for (std::size_t i = 0; i < places.size(); i++) {
        const double a = ours[places[i]], b = theirs[i];
        found += std::isfinite(b);
        by_one += std::isfinite(a) != std::isfinite(b);
        if (std::isfinite(a) && std::isfinite(b)) most = std::max(most, std::fabs(a - b));
      }
      of_ways[w].asked = places.size();
      of_ways[w].facts =
          format("found=%zu found_by_one=%zu largest_difference=%.2g ", found, by_one, most);
    }
  for (std::size_t w = 0; w < ways.size(); w++) {
    const Found &found = of_ways[w];
    row.what = place + ", " + ways[w].name;
    row.spheres = found.asked;
    row.timing = timing_of(found.ms);
    row.facts = format("ns_per_point=%.4g ", row.timing.median_ms * 1e6 / double(found.asked)) +
                found.facts + ways[w].setup;
    rows.add(row);
  }
}

// The time of a call of the library by itself: of one point that is far from a mesh.
void measure_call(const TriangleSoup &mesh, BenchRows &rows)
{
  const Grid grid(mesh_of(mesh));
  const double middle[3] = {0, 0, 0};
  double distance = 0;
  Query<double> q(middle, 1);
  q.threads = 1;
  q.radius = kNear;
  q.distance = &distance;
  constexpr int kCalls = 100000;
  BenchRow row;
  row.what = "call, far";
  row.triangles = mesh.n_triangles();
  row.spheres = 1;
  row.order = "random";
  row.timing = time_it(
      5,
      [&] {
        for (int k = 0; k < kCalls; k++) grid.query(q);
      },
      kCalls);
  rows.add(row);
}

void measure_on(Device device, const BenchOptions &o, BenchRows &rows)
{
  const bool cuda = device == Device::cuda;
  const std::size_t n = static_cast<std::size_t>(o.spheres > 0 ? o.spheres
                                                 : o.quick     ? 1e4
                                                 : cuda        ? 1e7
                                                               : 1e6);
  const double most = o.most_triangles > 0 ? o.most_triangles : o.quick ? 1e4 : 1e6;
  const int repeats = o.repeats > 0 ? o.repeats : 3;
  rows.begin(device);
  for (const int m : {16, 50, 158, 500}) {
    if (4. * m * (m - 1) > most) continue;
    const TriangleSoup mesh = sphere_mesh(m);
    std::vector<Way> ways = {library_way(mesh, device)};
    for (const Peer &peer : {embree(), cgal()})
      if (peer.build && !cuda) ways.push_back(peer_way(peer, mesh));
    const Real side = 1 + kNear;
    const SphereBox box = {{-side, -side, -side}, {side, side, side}, kNear, kSeed};
    const struct {
      const char *name;
      std::vector<Sphere> points;
      const SphereBox &curve;    // by which they are sorted
    } places[] = {{"near", near_points(mesh, n), box},
                  {"far", far_points(ways[0], box, n), box},
                  {"any", any_points(cuda ? n : std::max<std::size_t>(n / 20, 1000)), kAround}};
    for (const auto &place : places) {
      std::vector<Sphere> points = place.points;
      BenchRow row;
      row.triangles = mesh.n_triangles();
      for (const char *order : {"random", "sorted"}) {
        if (order[0] == 's') sort(points, place.curve);
        row.order = order;
        compare(ways, points, repeats, row, place.name, rows);
      }
    }
    if (m == 16 && !cuda) measure_call(mesh, rows);
  }
}

void measure(const BenchOptions &options, BenchRows &rows)
{
  for (const Peer &peer : {embree(), cgal()})
    if (!peer.build)
      std::fprintf(stderr, "skipped: %s (%s is not installed)\n", peer.name.c_str(), peer.package);
  const OneThread one;
  for (Device device : options.devices) measure_on(device, options, rows);
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(
      argc, argv, "query",
      "Distances of points to a sphere of triangles, by the library and by others: CSV.", measure);
}
