// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random meshes x random spheres x random grids against trying every triangle.
//   LSDCD_PAIRS  sphere-mesh pairs, and steps of walks, 1e6 unless given, or 1e7 on a GPU (1e9 takes minutes there)
//   LSDCD_SEED   first seed, 1 unless given
//   LSDCD_MESH   only the mesh of this number: what a failure prints
// On CUDA the grid, the contacts and the oracle all run there (properties_cuda.cu).
#include "support/device.h"
#include "support/hard_case.h"
#include "support/laws.h"
#include "support/pair_check.h"
#include "support/properties.h"

#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "mesh/face_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <set>

namespace lsdcd {
namespace {

constexpr const char *kTheme = "Random meshes and spheres";

double setting(const char *name, double otherwise)
{
  const char *text = std::getenv(name);
  return text && *text ? std::atof(text) : otherwise;
}

std::uint64_t first_seed()
{
  return static_cast<std::uint64_t>(setting("LSDCD_SEED", 1));
}

// Calls f(mesh number) for as many as there are, one thread each.
template <class F>
void for_meshes(long n, bool parallel, F f)
{
  const long only = static_cast<long>(setting("LSDCD_MESH", -1));
#pragma omp parallel for schedule(dynamic) if (parallel)
  for (long i = 0; i < n; i++)
    if (only < 0 || only == i) f(i);
}

std::uint64_t seed_of(long mesh)
{
  return Numbers(first_seed() * 1000003ull + static_cast<std::uint64_t>(mesh)).next();
}

// The mesh of a number with its grid; the grid's own length where the one drawn does
// not fit in memory.
struct Wall {
  RandomMesh made;
  WeldedMesh mesh;
  StepGrid grid;

  explicit Wall(std::uint64_t seed, bool on_cuda = false) :
      made(random_mesh(seed)), mesh(weld(made.soup, 0))
  {
    StepGridSettings settings;
    settings.cutoff = made.cutoff;
    settings.length = made.length;
    settings.memory_budget = 64 << 20;
    try {
      grid = build_grid(mesh, settings, on_cuda);
    } catch (const InputError &) {
      settings.length = 0;
      grid = build_grid(mesh, settings, on_cuda);
    }
  }

  template <class T>
  PairMesh<T> pairs(const std::vector<LongTriangle<T>> &triangles, std::uint64_t seed) const
  {
    return {grid.view(),
            triangles.data(),
            made.soup.corners.data(),
            int(triangles.size()),
            mesh.report.lo,
            mesh.report.hi,
            made.cutoff,
            pair_tolerance(mesh.report, grid),
            seed};
  }
};

void report(const PairTotals &t, double seconds)
{
  std::printf("  seed %llu: %.4g pairs on %ld meshes in %.0f s, %.4g touch; largest error %.3f of "
              "the tolerance\n",
              static_cast<unsigned long long>(first_seed()), double(t.pairs), t.meshes, seconds,
              double(t.touching), t.error);
  char what[80];
  std::snprintf(what, sizeof what, "%.3g pairs on %ld meshes", double(t.pairs), t.meshes);
  const std::string where = " (first: LSDCD_MESH=" + std::to_string(t.first_mesh) + ", sphere " +
                            std::to_string(t.first_sphere) + ")";
  expect_answer({kTheme, "1", std::string(what) + ": missed contacts"}, 0, t.missed, 0,
                "lists are complete" + (t.missed ? where : ""));
  expect_answer({kTheme, "1", std::string(what) + ": contacts past the cutoff"}, 0, t.not_there, 0,
                "to the tolerance of a distance" + (t.not_there ? where : ""));
  expect_answer({kTheme, "1", std::string(what) + ": NaN, normals not unit, weights off [0, 1]"}, 0,
                t.bad, 0, "none" + (t.bad ? where : ""));
  expect_at_most({kTheme, "1", std::string(what) + ": |d - d(all triangles)| / tolerance"}, t.error,
                 1, "1.5 tolerances + 8 eps (size + R)" + (t.wrong ? where : ""));
  EXPECT_GT(t.touching, t.pairs / 4);
}

double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TEST(property, the_nearest_contact_is_the_distance_to_all_triangles)
{
  const double n_pairs = random_pairs(), start = now();
  PairTotals totals;
  if (test_on_cuda()) {
#if defined(LSDCD_HAVE_CUDA)
    // Launches are large, so that a mesh is worth its grid.
    const long per_mesh = static_cast<long>(std::fmin(2e5, std::fmax(2e4, n_pairs / 500)));
    const long n_meshes = std::max(1l, static_cast<long>(n_pairs / per_mesh));
    for_meshes(n_meshes, false, [&](long i) {
      const std::uint64_t seed = seed_of(i);
      const Wall wall(seed, true);
      totals.add(check_pairs_on_cuda(wall.grid,
                                     wall.pairs(long_triangles<DoubleDouble>(wall.made.soup), seed),
                                     per_mesh),
                 i);
    });
#endif
  } else {
    constexpr long kPerMesh = 4000;
    for_meshes(static_cast<long>(n_pairs / kPerMesh), true, [&](long i) {
      const std::uint64_t seed = seed_of(i);
      const Wall wall(seed);
      const auto triangles = long_triangles<long double>(wall.made.soup);
      const PairMesh<long double> mesh = wall.pairs(triangles, seed);
      PairTotals mine;
      for (long k = 0; k < kPerMesh; k++) mine.count(check_pair<128, 128>(mesh, k), k);
#pragma omp critical
      totals.add(mine, i);
    });
  }
  report(totals, now() - start);
}

// ---- lists of the wall -----------------------------------------------------------------------

std::vector<FeatureCode> features_of(const Wall &wall)
{
  std::vector<FeatureCode> features = wall.grid.wall.contact_features;
  std::sort(features.begin(), features.end());
  return features;
}

// `features`: features_of(wall).
template <class T>
WalkMesh<T> walk_mesh(const Wall &wall, const std::vector<FeatureCode> &features,
                      const std::vector<LongTriangle<T>> &triangles, std::uint64_t seed,
                      Real gathered)
{
  return {wall.pairs(triangles, seed), features.data(), static_cast<int>(features.size()),
          gathered};
}

// Walks of spheres on as many meshes as n_steps take, their lists gathered for a share of the
// margin; `first`: the first mesh and sphere that failed.
Walks walk(double n_steps, Real gathered, std::string &first)
{
  const bool cuda = test_on_cuda();
  const double spheres = n_steps / kWalkSteps;
  const long per_mesh =
      cuda ? static_cast<long>(std::fmin(1e5, std::fmax(250, spheres / 500))) : 250;
  Walks total;
  long first_mesh = -1;
  for_meshes(std::max(1l, static_cast<long>(spheres / per_mesh)), !cuda, [&](long i) {
    const std::uint64_t seed = seed_of(i);
    const Wall wall(seed, cuda);
    const std::vector<FeatureCode> features = features_of(wall);
    std::vector<Walks> walks(per_mesh);
    if (features.empty()) return;
    if (cuda) {
#if defined(LSDCD_HAVE_CUDA)
      const auto triangles = long_triangles<DoubleDouble>(wall.made.soup);
      walks = check_walks_on_cuda(wall.grid, walk_mesh(wall, features, triangles, seed, gathered),
                                  per_mesh);
#endif
    } else {
      const auto triangles = long_triangles<long double>(wall.made.soup);
      const auto mesh = walk_mesh(wall, features, triangles, seed, gathered);
      for (long k = 0; k < per_mesh; k++) walks[k] = check_walk(mesh, k);
    }
    Walks mine;
    long failed = -1;
    for (long k = per_mesh - 1; k >= 0; k--) {
      mine.add(walks[k]);
      if (walks[k].failed()) failed = k;
    }
#pragma omp critical
    {
      total.add(mine);
      if (failed >= 0 && (first_mesh < 0 || i < first_mesh)) {
        first_mesh = i;
        first =
            " (first: LSDCD_MESH=" + std::to_string(i) + ", sphere " + std::to_string(failed) + ")";
      }
    }
  });
  return total;
}

TEST(property, a_list_holds_every_contact_inside_of_its_margin)
{
  const double n_steps = random_pairs();
  std::string where;
  const double start = now();
  const Walks t = walk(n_steps, 1, where);
  std::printf("  %.4g steps of %.4g spheres in %.0f s, %.0f %% have a list, %.0f %% touch; "
              "largest error %.3f of the tolerance\n",
              double(t.steps), double(t.spheres), now() - start, 100. * t.with_list / t.spheres,
              100. * t.touching / t.steps, t.error);
  char what[80];
  std::snprintf(what, sizeof what, "%.3g steps inside the margin: ", double(t.steps));
  const auto none = [&](const char *of, long n) {
    expect_answer({kTheme, "3", std::string(what) + of}, 0, n, 0, "none" + where);
  };
  none("contacts that lists miss", t.missed);
  none("contacts of lists alone", t.extra);
  none("steps that touch, of spheres that a choice leaves out", t.pruned);
  none("contacts of cells that no listed feature has", t.by_cells);
  none("nearest contacts at no distance to all triangles", t.wrong);
  EXPECT_GT(t.with_list, t.spheres / 2);
  EXPECT_GT(t.touching, t.steps / 4);
}

// The check can fail: lists for a margin 1 % short of what is walked miss contacts.
TEST(property, a_list_for_less_than_the_margin_is_seen_to_miss_contacts)
{
  if (setting("LSDCD_MESH", -1) >= 0) GTEST_SKIP() << "one mesh may have no contact to miss";
  std::string where;
  const Walks t = walk(1e5, Real(0.99), where);
  std::printf("  %ld contacts missed in %ld steps\n", t.missed, t.steps);
  EXPECT_GT(t.missed, 0);
  EXPECT_GT(t.pruned, 0);
}

// ---- local minima ----------------------------------------------------------------------------

using LongVec = LongVec3<LongReal>;

LongReal length(const LongVec &a)
{
  return std::sqrt(dot(a, a));
}
LongVec minus(const LongVec &a, const LongVec &b)
{
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

// The wall as triangles, and three segments (two equal corners) for each facet that
// has no face: what its edges are to the wall.
TriangleSoup primitives(const Wall &wall)
{
  TriangleSoup out;
  std::vector<bool> is_face(wall.made.soup.n_triangles(), false);
  for (std::size_t facet : wall.mesh.face_facet) is_face[facet] = true;
  for (std::size_t t = 0; t < is_face.size(); t++) {
    const Vec3 *p = wall.made.soup.corners.data() + 3 * t;
    if (is_face[t]) {
      out.corners.insert(out.corners.end(), {p[0], p[1], p[2]});
      continue;
    }
    const FacePlane plane = face_plane(p[0], p[1], p[2]);
    if (!plane.degenerate) continue;    // given before
    for (int k = 0; k < 3; k++)
      out.corners.insert(out.corners.end(), {p[k], p[(k + 1) % 3], p[(k + 1) % 3]});
  }
  return out;
}

// The closest point of each primitive is a local minimum of the wall if it is the closest
// point of every primitive that shares the corner or the side that it lies on. Positions
// are good to the tolerance, so that minima are asked for at eight points a little way
// off: sure where all have one, possible where one has, or where a point a little
// nearer to the middle of the primitive has: in a sharp corner none of the eight is inside.
struct Minimum {
  LongVec closest;    // from q
  int seen = 0;       // a bit for each point
};

class Minima {
 public:
  static constexpr int kPoints = 8;
  using Map =
      std::map<std::vector<int>, Minimum>;    // by the primitives that hold the closest point

  explicit Minima(const Wall &wall) :
      triangles_(long_triangles<LongReal>(primitives(wall))),
      shift_(16 * pair_tolerance(wall.mesh.report, wall.grid))
  {
    std::map<std::array<Real, 3>, int> number;
    for (const auto &t : triangles_) {
      std::array<int, 3> v;
      for (int k = 0; k < 3; k++) {
        const Vec3 p = t.corner[k] + Vec3{0, 0, 0};    // -0.0 is 0.0
        v[k] = number.insert({{p.x, p.y, p.z}, static_cast<int>(number.size())}).first->second;
      }
      vertex_.push_back(v);
    }
    for (std::size_t t = 0; t < triangles_.size(); t++) {
      std::vector<Neighbour> near;
      for (std::size_t o = 0; o < triangles_.size(); o++) {
        Neighbour n = {static_cast<int>(o), {}};
        for (int k = 0; k < 3; k++)
          for (int j = 0; j < 3; j++)
            if (vertex_[t][k] == vertex_[o][j] &&
                std::none_of(n.corner.begin(), n.corner.end(),
                             [&](int c) { return vertex_[t][c] == vertex_[t][k]; }))
              n.corner.push_back(k);
        if (o != t && !n.corner.empty()) near.push_back(n);
      }
      neighbours_.push_back(near);
    }
  }

  // Closest points of one minimum, seen from points 256 shifts apart at most.
  Real close() const { return 512 * shift_; }

  Map around(const Vec3 &q, Real radius) const
  {
    Map out;
    for (int k = 0; k < kPoints; k++) {
      const Vec3 p =
          q + Vec3{k & 1 ? shift_ : -shift_, k & 2 ? shift_ : -shift_, k & 4 ? shift_ : -shift_};
      for (std::size_t t = 0; t < triangles_.size(); t++)
        add(t, p, q, radius + (k & 1 ? shift_ : -shift_), k, out);
    }
    for (std::size_t t = 0; t < triangles_.size(); t++) {
      const Vec3 in = triangles_[t].centre - q;
      const LongVec w = from_to<LongReal>(triangles_[t].corner[0], q),
                    closest = foot_of(triangles_[t], w);
      const Vec3 up = {static_cast<Real>(w.x - closest.x), static_cast<Real>(w.y - closest.y),
                       static_cast<Real>(w.z - closest.z)};
      const Vec3 along = in + up;    // from the closest point
      for (Real s : {16., 256.})
        if (norm(along) > 0)
          add(t, q + (s * shift_ / norm(along)) * along, q, radius + s * shift_, kPoints, out);
    }
    return out;
  }

 private:
  struct Neighbour {
    int primitive;
    std::vector<int> corner;    // those of ours that it shares
  };

  // A point counts as lying on a primitive this near to it.
  LongReal on() const { return 1e-3L * shift_; }

  // Is x, from corner 0 of primitive t, on what t shares with its neighbour?
  bool is_shared(const LongTriangle<LongReal> &t, const Neighbour &n, const LongVec &x) const
  {
    if (n.corner.size() == 3) return true;
    const LongVec a = from_to<LongReal>(t.corner[0], t.corner[n.corner[0]]);
    if (n.corner.size() == 1) return length(minus(x, a)) <= on();
    const LongVec b = from_to<LongReal>(t.corner[0], t.corner[n.corner[1]]), e = minus(b, a);
    LongReal s = dot(minus(x, a), e) / dot(e, e);
    s = s < 0 ? 0 : (s > 1 ? 1 : s);
    return length(minus(x, {a.x + s * e.x, a.y + s * e.y, a.z + s * e.z})) <= on();
  }

  // The minimum on primitive t as seen from p, the k-th point about q.
  void add(std::size_t t, const Vec3 &p, const Vec3 &q, Real radius, int k, Map &out) const
  {
    const LongVec w = from_to<LongReal>(triangles_[t].corner[0], p);
    const LongVec closest = foot_of(triangles_[t], w);
    if (!(length(minus(w, closest)) < radius)) return;
    std::vector<int> holding = {static_cast<int>(t)};
    for (const Neighbour &n : neighbours_[t]) {
      if (!is_shared(triangles_[t], n, closest)) continue;
      const auto &o = triangles_[n.primitive];
      holding.push_back(n.primitive);
      const LongVec between = from_to<LongReal>(o.corner[0], triangles_[t].corner[0]);
      const LongVec x = {closest.x + between.x, closest.y + between.y, closest.z + between.z};
      const LongVec other = foot_of(o, from_to<LongReal>(o.corner[0], p));
      if (length(minus(other, x)) > on()) return;
    }
    std::sort(holding.begin(), holding.end());
    Minimum &m = out[holding];
    const LongVec from_q = from_to<LongReal>(q, triangles_[t].corner[0]);
    m.closest = {from_q.x + closest.x, from_q.y + closest.y, from_q.z + closest.z};
    m.seen |= 1 << k;
  }

  std::vector<LongTriangle<LongReal>> triangles_;
  std::vector<std::array<int, 3>> vertex_;
  std::vector<std::vector<Neighbour>> neighbours_;
  Real shift_;
};

TEST(property, contacts_are_the_local_minima)
{
  if (test_on_cuda()) GTEST_SKIP() << "the CPU's contacts are compared; forces are below";
  const long n_meshes = static_cast<long>(random_pairs() / 1e4);
  constexpr long kPerMesh = 100;
  long missing = 0, extra = 0, doubled = 0, sure = 0, first = -1;
  for_meshes(n_meshes, true, [&](long i) {
    const std::uint64_t seed = seed_of(i);
    const Wall wall(seed);
    const auto triangles = long_triangles<LongReal>(wall.made.soup);
    const PairMesh<LongReal> mesh = wall.pairs(triangles, seed);
    const Minima minima(wall);
    long not_there = 0, not_one = 0, twice = 0, n_sure = 0;
    for (long k = 0; k < kPerMesh; k++) {
      const Sphere s = sphere_of(mesh, k);
      const auto expected = minima.around(s.x, s.radius);
      ContactSet<128> set;
      find_contacts(mesh.grid, s.x, s.radius, set);
      // A closest point e aside is e^2 / 2d farther: within the tolerance of a distance it
      // cannot be told from the minimum.
      const auto is_at = [&](int c, const Minimum &m) {
        const Vec3 ours = -set.distance[c] * set.normal[c];
        const LongReal apart =
            length({m.closest.x - ours.x, m.closest.y - ours.y, m.closest.z - ours.z});
        const LongReal farther = std::fabs(set.distance[c] - length(m.closest));
        return apart <= minima.close() || (farther <= 2 * mesh.tolerance &&
                                           apart * apart <= 8 * mesh.tolerance * set.distance[c]);
      };
      for (const auto &m : expected) {
        if (m.second.seen != (m.second.seen | ((1 << Minima::kPoints) - 1))) continue;
        n_sure++;
        bool found = false;
        for (int c = 0; c < set.n; c++) found = found || is_at(c, m.second);
        not_there += !found;
      }
      for (int c = 0; c < set.n; c++) {
        bool is_one = false;
        for (const auto &m : expected) is_one = is_one || is_at(c, m.second);
        not_one += !is_one;
        for (int o = 0; o < c; o++)
          twice += norm(set.distance[c] * set.normal[c] - set.distance[o] * set.normal[o]) <=
                   3.9 * mesh.grid.tolerance;
      }
    }
#pragma omp critical
    {
      missing += not_there;
      extra += not_one;
      doubled += twice;
      sure += n_sure;
      if (first < 0 && (not_there || not_one || twice)) first = i;
    }
  });
  std::printf("  %ld minima on %ld meshes\n", sure, n_meshes);
  const std::string where = first < 0 ? "" : ", first: LSDCD_MESH=" + std::to_string(first);
  expect_answer({kTheme, "2", "local minima without a contact"}, 0, missing, 0, "none" + where);
  expect_answer({kTheme, "2", "contacts at no local minimum"}, 0, extra, 0, "none" + where);
  expect_answer({kTheme, "2", "contacts twice at one point"}, 0, doubled, 0,
                "points 4 tolerances apart are one" + where);
  EXPECT_GT(sure, n_meshes * kPerMesh / 10);
}

// ---- forces -------------------------------------------------------------------------------------

// The engine that is tested and the CPU's, on the same spheres: the same bits.
TEST(property, forces_are_finite_and_those_of_the_cpu)
{
  const long n_meshes = static_cast<long>(std::fmin(random_pairs() / 2e4, 5000));
  constexpr int kPerMesh = 500;
  long not_finite = 0, differ = 0, touching = 0, first = -1;
  for_meshes(n_meshes, !test_on_cuda(), [&](long i) {
    const std::uint64_t seed = seed_of(i);
    const Wall wall(seed, test_on_cuda());
    const auto triangles = long_triangles<long double>(wall.made.soup);
    const PairMesh<long double> mesh = wall.pairs(triangles, seed);
    const FlatOf<StepGrid> flat(wall.grid);
    Numbers r(seed + 7);
    SphereArrays all;
    for (int k = 0; k < kPerMesh; k++) {
      const Sphere s = sphere_of(mesh, k);
      const Vec3 u = r.direction(), w = r.direction();
      all.add(s.x, s.radius, 1, u, w);
    }
    EngineSettings law = hertz_history(1e3, 1e2, 1, 0.5, 0.4);
    law.corner = r.below(4) ? Corner::blend : Corner::sum;
    std::vector<Real> force[2], torque[2];
    const auto run = [&](Device device, int at) {
      law.device = device;
      const auto engine = make_engine(law);
      engine->set_grid(flat.view());
      ContactHistory springs;
      springs.grow(kPerMesh);
      all.clear_forces();
      StepSettings step;
      step.dt = 1e-4;
      for (int k = 0; k < 2; k++) {    // the second step finds the springs of the first
        step_once(*engine, all.spheres(), step, &springs);
      }
      force[at] = all.force;
      torque[at] = all.torque;
      return engine->results().totals().contacts;
    };
    const long contacts = static_cast<long>(run(test_device(), 0));
    if (test_on_cuda()) run(Device::cpu, 1);
    long bad = 0, other = 0;
    for (int k = 0; k < 3 * kPerMesh; k++)
      bad += !std::isfinite(force[0][k]) || !std::isfinite(torque[0][k]);
    if (test_on_cuda())
      other = std::memcmp(force[0].data(), force[1].data(), force[0].size() * sizeof(Real)) != 0 ||
              std::memcmp(torque[0].data(), torque[1].data(), torque[0].size() * sizeof(Real)) != 0;
#pragma omp critical
    {
      not_finite += bad;
      differ += other;
      touching += contacts;
      if (first < 0 && (bad || other)) first = i;
    }
  });
  std::printf("  %ld contacts on %ld meshes\n", touching, n_meshes);
  EXPECT_EQ(not_finite, 0) << "first: LSDCD_MESH=" << first;
  EXPECT_EQ(differ, 0) << "first: LSDCD_MESH=" << first;
  EXPECT_GT(touching, n_meshes * kPerMesh / 10);
}

}    // namespace
}    // namespace lsdcd
