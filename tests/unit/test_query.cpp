// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The library's query of points in cells against every triangle tried in more digits, and one backend against the other.
#include "support/brute_force_long.h"
#include "support/device.h"
#include "support/device_memory.h"
#include "support/meshes.h"
#include "support/random_mesh.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "grid/lookup/grid_on.h"
#include "mesh/welded_mesh.h"
#include "query/brick_distances.h"
#include "query/point_query.h"
#include "support/says.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <thread>

namespace lsdcd::test_query {
namespace {

// A wall, the grids that are asked for, spheres near it and where the wall truly is.
struct Case {
  TriangleSoup soup;
  WeldedMesh mesh;
  TriangleTable names;
  Real cutoff, length;
  std::vector<Sphere> spheres;
  std::vector<Real> truth;

  Case(TriangleSoup given, Real cutoff_, Real length_, std::size_t n, std::uint64_t seed) :
      soup(std::move(given)), mesh(weld(soup, 0)), names(mesh), cutoff(cutoff_), length(length_)
  {
    const auto triangles = long_triangles<LongReal>(soup);
    Numbers r(seed);
    for (std::size_t i = 0; i < n; i++) {
      const Vec3 x = random_centre(r, soup.corners.data(), int(soup.n_triangles()), mesh.report.lo,
                                   mesh.report.hi, cutoff);
      spheres.push_back({x.x, x.y, x.z, cutoff * (r.below(2) ? 1 : r.log_in(1e-3, 1))});
      truth.push_back(long_distance(triangles.data(), int(triangles.size()), x));
    }
  }

  QueryGrid grid(int nearest, bool in_floats = false) const
  {
    QueryGridSettings settings;
    settings.cutoff = cutoff;
    settings.length = length;
    settings.nearest = nearest;
    settings.in_floats = in_floats;
    settings.memory_budget = 256 << 20;
    try {
      return build_grid(mesh, settings, test_on_cuda());
    } catch (const InputError &) {
      settings.length = 0;
      return build_grid(mesh, settings, test_on_cuda());
    }
  }

  // A region test is closed by the tolerance, so that a closest point lies that far off at most, once
  // along each of two sides; the rest is rounding of coordinates and of their differences.
  Real tolerance(const QueryGrid &grid) const
  {
    Real size = 0;
    for (int k = 0; k < 3; k++)
      size = std::fmax(size, std::fmax(std::fabs(mesh.report.lo[k]), std::fabs(mesh.report.hi[k])));
    return 1.5 * grid.tolerance + 16 * kRoundoff * (size + cutoff);
  }
};

struct Answers {
  std::vector<std::uint8_t> status;
  std::vector<Real> distance;

  bool touching(std::size_t i) const { return status[i] & kFound; }
  bool certified(std::size_t i) const { return status[i] & kCertified; }
};

static_assert(std::is_constructible_v<CpuGrid, ViewOf<QueryGrid>>);
static_assert(!std::is_constructible_v<CpuGrid, ViewOf<StepGrid>>);

// The library's query of one grid, on the CPU or on a GPU.
class GridQuery {
 public:
  GridQuery(const Case &c, const QueryGrid &grid, Device device = test_device()) :
      names_(c.names), flat_(grid), cuda_(device == Device::cuda)
  {
#if defined(LSDCD_HAVE_CUDA)
    if (cuda_) {
      on_gpu_ = copy_to_cuda(flat_.view(), names_)->query_on(nullptr);
      return;
    }
#endif
    on_cpu_ = CpuGrid(flat_.view());
  }

  // S: Sphere or FloatSphere, whose distances are in float.
  template <class S>
  Answers ask(const std::vector<S> &spheres)
  {
    using T = decltype(S::x);
    const std::size_t n = spheres.size();
    DeviceArray<S> given(cuda_);
    DeviceArray<T> distance(cuda_);
    DeviceArray<std::uint8_t> status(cuda_);
    const S *at = given.put(spheres);
    PointArrays<T> io;
    io.n = n;
    io.points = {&at->x, 4, 1};
    io.radii = {&at->r, 4};
    io.distance = {distance.resize(n), 1};
    io.status = status.resize(n);
    if (on_gpu_)
      on_gpu_->enqueue(io);
    else
      query_grid(on_cpu_, names_, io);
    const std::vector<T> found = distance.get(n);
    return {status.get(n), {found.begin(), found.end()}};
  }

 private:
  const TriangleTable &names_;
  FlatOf<QueryGrid> flat_;
  bool cuda_;
  CpuGrid on_cpu_;
  std::unique_ptr<StreamQuery> on_gpu_;
};

template <class S>
Answers ask(const Case &c, const QueryGrid &grid, const std::vector<S> &spheres,
            Device device = test_device())
{
  return GridQuery(c, grid, device).ask(spheres);
}

std::vector<Case> cases()
{
  std::vector<Case> out;
  out.emplace_back(cylinder_mesh(40, 1, 50, 100), 1, 0.5, 4000, 1);
  out.emplace_back(cylinder_mesh(24, 6, 1, 2), 0.3, 0.1, 4000, 2);
  out.emplace_back(box_mesh({0, 0, 0}, {1, 2, 3}), 0.4, 0, 4000, 3);
  out.emplace_back(cone_mesh(200, 1, 0.5), 0.2, 0, 2000, 4);
  const int n_random = std::getenv("LSDCD_QUICK") ? 10 : 60;
  for (int i = 0; i < n_random; i++) {
    RandomMesh m = random_mesh(100 + i);
    try {
      out.emplace_back(std::move(m.soup), m.cutoff, m.length, 1000, 5 + i);
    } catch (const InputError &) {
      continue;    // nothing but points closer than the tolerance
    }
  }
  return out;
}

const std::vector<Case> &all_cases()
{
  static const std::vector<Case> made = cases();
  return made;
}

// How the answer to sphere i is wrong, or null.
const char *fault(const Case &c, const Answers &a, std::size_t i, Real tolerance)
{
  const Real r = c.spheres[i].r, truth = c.truth[i];
  if (a.touching(i) != (a.distance[i] < kAnyDistance)) return "status and distance disagree";
  if (a.touching(i) && !(a.distance[i] < r)) return "farther than the radius";
  if (!a.touching(i) && truth < r - tolerance) return "missed";
  if (a.touching(i) && truth > r + tolerance) return "not there";
  if (a.touching(i) && !(std::fabs(a.distance[i] - truth) <= tolerance)) return "wrong distance";
  return nullptr;
}

void expect_right(const Case &c, const Answers &a, Real tolerance, bool only_certified,
                  const std::string &lists)
{
  std::size_t bad = 0;
  for (std::size_t i = 0; i < c.spheres.size(); i++) {
    if (only_certified && !a.certified(i)) continue;
    const char *what = fault(c, a, i, tolerance);
    if (!what || bad++) continue;
    ADD_FAILURE() << c.soup.source << ", " << lists << ", sphere " << i << ": " << what
                  << ", distance " << a.distance[i] << ", true " << c.truth[i] << ", radius "
                  << c.spheres[i].r << ", tolerance " << tolerance;
  }
  EXPECT_EQ(bad, 0u) << c.soup.source << ", " << lists;
}

TEST(query, complete_lists_give_the_distance_of_every_triangle_tried)
{
  for (const Case &c : all_cases()) {
    const QueryGrid grid = c.grid(0);
    const Answers a = ask(c, grid, c.spheres);
    expect_right(c, a, c.tolerance(grid), false, "complete");
    for (std::size_t i = 0; i < c.spheres.size(); i++) ASSERT_TRUE(a.certified(i));
  }
}

TEST(query, certified_answers_of_nearest_lists_are_right)
{
  std::size_t certified = 0, uncertified = 0;
  for (const Case &c : all_cases())
    for (int n = 1; n <= 8; n++) {
      const QueryGrid grid = c.grid(n);
      const Answers a = ask(c, grid, c.spheres);
      expect_right(c, a, c.tolerance(grid), true, std::to_string(n));
      for (std::size_t i = 0; i < c.spheres.size(); i++)
        (a.certified(i) ? certified : uncertified)++;
    }
  // There are many of both, or the test says nothing.
  EXPECT_GT(certified, 100000u);
  EXPECT_GT(uncertified, 10000u);
}

TEST(query, answers_on_10000_triangles_are_right)
{
  const Case c(cylinder_mesh(100, 49, 50, 100), 1, 0, 300, 6);
  for (const int n : {0, 3}) {
    const QueryGrid grid = c.grid(n);
    expect_right(c, ask(c, grid, c.spheres), c.tolerance(grid), n > 0, std::to_string(n));
  }
}

TEST(query, a_list_cut_off_can_only_lose_contacts)
{
  std::size_t wrong = 0;
  for (const Case &c : all_cases())
    for (int n : {1, 2, 5}) {
      const QueryGrid grid = c.grid(n);
      const Answers a = ask(c, grid, c.spheres);
      for (std::size_t i = 0; i < c.spheres.size(); i++) {
        if (a.touching(i)) {
          ASSERT_GE(a.distance[i], c.truth[i] - c.tolerance(grid)) << c.soup.source;
        }
        wrong += fault(c, a, i, c.tolerance(grid)) != nullptr;
      }
    }
  EXPECT_GT(wrong, 1000u);    // else no list was cut off where it matters
}

TEST(query, longer_lists_of_one_grid_are_those_of_another)
{
  // The first N entries of a longer list, and the next as a bound, are the list of N.
  const Case &c = all_cases()[1];
  QueryGrid eight = c.grid(8);
  for (int n = 1; n < 8; n++) {
    eight.list_kind = ListKind::of_option(n);
    const Answers a = ask(c, eight, c.spheres), b = ask(c, c.grid(n), c.spheres);
    EXPECT_EQ(a.status, b.status) << n;
    EXPECT_EQ(a.distance, b.distance) << n;
  }
}

TEST(query, answers_in_float_are_within_float_rounding_of_a_brick)
{
  for (std::size_t k : {0, 1, 2, 3}) {
    const Case &c = all_cases()[k];
    for (int n : {0, 2, 4}) {
      const QueryGrid grid = c.grid(n, true);
      const Answers a = ask(c, grid, c.spheres);
      expect_right(c, a, 2 * BrickDistances::tolerance(grid.view()), n > 0,
                   "floats, " + std::to_string(n));
    }
  }
}

TEST(query, gives_the_same_bits_on_both_devices)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  for (const Case &c : all_cases())
    for (const bool in_floats : {false, true})
      for (int n : {0, 1, 3}) {
        const QueryGrid grid = c.grid(n, in_floats);
        const Answers cpu = ask(c, grid, c.spheres, Device::cpu),
                      cuda = ask(c, grid, c.spheres, Device::cuda);
        EXPECT_EQ(cpu.status, cuda.status) << c.soup.source;
        // Two features may be at distance 0 with signs that differ: a warp may take the other of them.
        for (std::size_t i = 0; i < c.spheres.size(); i++)
          ASSERT_EQ(cpu.distance[i], cuda.distance[i])
              << c.soup.source << ", nearest " << n << (in_floats ? ", floats" : "") << ", sphere "
              << i;
      }
}

// The cell's list where q has candidates, as a GPU finds it; elsewhere a list of 0.
Cell cell_by_words(const GridView &grid, const BrickTable &table, const Vec3 &q)
{
  const std::uint32_t cell = occupied_cell(grid, table, q);
  return cell == kNoCell ? Cell{0, 0} : grid.lists.cells[cell];
}

// All far, four at a time, and then those near from their cell's list: the work of the GPU's kernels for distances
// alone, on the CPU.
Answers ask_cells_first(const QueryGrid &grid, const std::vector<Sphere> &spheres)
{
  CpuBackend b;
  const GridOn<CpuBackend> g(b, FlatGrid(grid), true);
  const std::size_t n = spheres.size();
  Answers found = {std::vector<std::uint8_t>(n), std::vector<Real>(n)};
  const DistanceArrays<Real> out = {found.status.data(), found.distance.data()};
  std::uint64_t too_large = 0;
  with_list_search(g.view, [&](auto search) {
    const GridWork<decltype(search), Sphere> work = {g.view,
                                                     g.table,
                                                     spheres.data(),
                                                     out,
                                                     BrickFilter<Real>(g.view),
                                                     g.coarse,
                                                     {g.view.cutoff, &too_large},
                                                     0};
    std::size_t far = 0;
    for (; far + 4 <= n; far += 4) work.four_far(far);
    for (; far < n; far++) work.far(far);
    for (std::size_t i = 0; i < n; i++) {
      const Sphere &s = spheres[i];
      work.check(i, s);
      const Cell cell = cell_by_words(g.view, g.table, s.centre());
      if (cell.count > 0) work.search_list(i, s, cell);
    }
  });
  if (too_large != 0) throw InputError("a radius is too large");
  return found;
}

TEST(query, asking_for_the_cell_first_changes_no_bit)
{
  for (const Case &c : all_cases())
    for (const bool in_floats : {false, true})
      for (int n : {0, 1, 3}) {
        const QueryGrid grid = c.grid(n, in_floats);
        const Answers a = ask_cells_first(grid, c.spheres),
                      b = ask(c, grid, c.spheres, Device::cpu);
        EXPECT_EQ(a.status, b.status) << c.soup.source;
        EXPECT_EQ(a.distance, b.distance) << c.soup.source;
      }
}

// Four threads in place of a warp.
class FourLanes {
 public:
  static constexpr unsigned kSize = 4;
  struct Shared {
    Shared() { pthread_barrier_init(&barrier, nullptr, kSize); }
    ~Shared() { pthread_barrier_destroy(&barrier); }
    pthread_barrier_t barrier;
    Real value[kSize];
  };

  FourLanes(Shared &shared, unsigned lane) : shared_(shared), lane_(lane) {}
  unsigned rank() const { return lane_; }
  Real of(Real value, unsigned lane) const
  {
    shared_.value[lane_] = value;
    pthread_barrier_wait(&shared_.barrier);
    const Real other = shared_.value[lane];
    pthread_barrier_wait(&shared_.barrier);
    return other;
  }
  Real from_below(Real value, unsigned step) const
  {
    return of(value, lane_ >= step ? lane_ - step : lane_);
  }
  unsigned vote(bool yes) const
  {
    shared_.value[lane_] = yes;
    pthread_barrier_wait(&shared_.barrier);
    unsigned all = 0;
    for (unsigned k = 0; k < kSize; k++)
      if (shared_.value[k] > 0) all |= 1u << k;
    pthread_barrier_wait(&shared_.barrier);
    return all;
  }

 private:
  Shared &shared_;
  unsigned lane_;
};

template <class Distances>
void expect_lanes_find_as_one(const Case &c, bool in_floats, std::uint32_t &longest)
{
  const QueryGrid grid = c.grid(0, in_floats);
  const GridView view = grid.view();
  std::vector<Sphere> spheres;
  std::vector<Cell> cells;
  const std::vector<BrickWord> words = brick_words(view);
  for (const Sphere &s : c.spheres) {
    const Cell cell = cell_by_words(view, BrickTable(words, words.data()), s.centre());
    if (cell.count < 2 || cells.size() == 40) continue;
    spheres.push_back(s);
    cells.push_back(cell);
  }
  FourLanes::Shared shared;
  std::vector<Answer> answers[FourLanes::kSize];
  std::vector<std::thread> threads;
  for (unsigned lane = 0; lane < FourLanes::kSize; lane++)
    threads.emplace_back([&, lane] {
      for (std::size_t i = 0; i < cells.size(); i++) {
        const Vec3 q = spheres[i].centre();
        answers[lane].push_back(nearest_in_warp<Distances>(view, q, spheres[i].r, locate(view, q),
                                                           cells[i], FourLanes(shared, lane)));
      }
    });
  for (std::thread &t : threads) t.join();
  for (std::size_t i = 0; i < cells.size(); i++) {
    const Answer one =
        nearest_distance<ListSearch<Distances, true>>(view, spheres[i].centre(), spheres[i].r);
    for (const std::vector<Answer> &of_lane : answers) {
      ASSERT_EQ(of_lane[i].distance, one.distance) << c.soup.source << " " << i;
      ASSERT_EQ(of_lane[i].certified, one.certified) << c.soup.source << " " << i;
    }
    longest = std::max(longest, cells[i].count);
  }
}

TEST(query, a_list_that_lanes_read_together_gives_what_one_finds)
{
  std::uint32_t longest = 0;
  for (const Case &c : all_cases()) {
    expect_lanes_find_as_one<MeshDistances>(c, false, longest);
    expect_lanes_find_as_one<BrickDistances>(c, true, longest);
  }
  EXPECT_GT(longest, 8 * FourLanes::kSize);    // some lists take many turns
}

// Numbers at, next to and far from the sides of cells and of the whole grid, and no numbers.
std::vector<Real> hard_coordinates(Real origin, Real length, int n_bricks)
{
  const Real inf = std::numeric_limits<Real>::infinity(),
             tiny = std::numeric_limits<Real>::denorm_min();
  std::vector<Real> out = {std::nan(""), inf, -inf, 1e300, -1e300, 0, -0., tiny, -tiny};
  const int n_cells = n_bricks * kBrickSide;
  for (int i : {-1, 0, 1, 7, 8, 9, n_cells / 2, n_cells - 1, n_cells, n_cells + 1}) {
    const Real side = origin + i * length;
    out.push_back(side + Real(0.5) * length);
    Real up = side, down = side;
    for (int k = 0; k < 4; k++) {
      out.push_back(up);
      out.push_back(down);
      up = std::nextafter(up, inf);
      down = std::nextafter(down, -inf);
    }
  }
  // So many cells on that 32 bits hold them no more, and would come round to the first.
  for (Real cells : {0x1p31, 0x1p32, 0x1p32 + n_cells / 2, 0x1p51, 0x1p52, 0x1p53, 0x1p64})
    for (Real sign : {-1., 1.}) out.push_back(origin + sign * cells * length);
  return out;
}

TEST(query, whole_numbers_below_are_those_of_floor)
{
  Numbers r(10);
  std::vector<Real> points = hard_coordinates(0, 1, 5);
  for (int i = 0; i < 100000; i++) {
    points.push_back((r.below(2) ? 1 : -1) * r.log_in(1e-20, 1e20));
    points.push_back(std::nextafter(std::floor(points.back()), r.below(2) ? -HUGE_VAL : HUGE_VAL));
  }
  for (Real x : points) {
    const WholeNumber whole = whole_below(x);
    ASSERT_EQ(whole.fits, x >= 0 && x < 0x1p32) << x;
    if (whole.fits) {
      ASSERT_EQ(whole.value, std::floor(x)) << x;
      ASSERT_EQ(whole.real, std::floor(x)) << x;
    }
  }
}

TEST(query, places_found_without_a_branch_are_those_found_with_them)
{
  for (std::size_t k : {0, 1, 2}) {
    const QueryGrid grid = all_cases()[k].grid(0);
    const GridView view = grid.view();
    std::size_t inside = 0;
    const auto expect_same = [&](const Vec3 &q) {
      const CellIndex p = cell_index_of(view, q);
      const BrickIndex at = brick_index_of(view, q);
      ASSERT_EQ(at.index != kNoBrick, p.inside) << q.x << " " << q.y << " " << q.z;
      if (!p.inside) return;
      inside++;
      ASSERT_EQ(at.index, brick_index(view, p)) << q.x << " " << q.y << " " << q.z;
      ASSERT_EQ(at.cell, cell_in_brick(p)) << q.x << " " << q.y << " " << q.z;
      const CellAddress address = address_inside(view, q);
      const Vec3 from_centre = from_cell_centre(view, p);
      ASSERT_EQ(address.cell, cell_in_brick(p)) << q.x << " " << q.y << " " << q.z;
      ASSERT_EQ(std::memcmp(&address.from_centre, &from_centre, sizeof from_centre), 0)
          << q.x << " " << q.y << " " << q.z;
    };
    std::vector<Real> along[3];
    for (int a = 0; a < 3; a++)
      along[a] = hard_coordinates(view.origin[a], view.length, view.n_bricks[a]);
    Numbers r(11);
    for (int i = 0; i < 200000; i++) {
      Vec3 q;
      for (int a = 0; a < 3; a++) q[a] = along[a][r.below(static_cast<int>(along[a].size()))];
      expect_same(q);
    }
    // One hard coordinate in a place that is inside.
    const Vec3 middle = view.origin + view.length * (kBrickSide / 2.) *
                                          Vec3{Real(view.n_bricks[0]), Real(view.n_bricks[1]),
                                               Real(view.n_bricks[2])};
    for (int a = 0; a < 3; a++)
      for (Real x : along[a]) {
        Vec3 q = middle;
        q[a] = x;
        expect_same(q);
      }
    EXPECT_GT(inside, 10000u);
  }
}

// A grid of so many bricks and no wall, which is all that a filter asks about.
GridView empty_grid(const Vec3 &origin, Real length, int nx, int ny, int nz)
{
  GridView view = {};
  view.origin = origin;
  view.length = length;
  view.inv_length = 1 / length;
  view.n_bricks[0] = nx;
  view.n_bricks[1] = ny;
  view.n_bricks[2] = nz;
  return view;
}

// How often the filter was sure, and of how many points.
struct Sureness {
  std::size_t sure = 0, inside = 0, points = 0;
};

template <class T>
void expect_filter_is_right(const GridView &view, const Vec3Of<T> &q, Sureness &count)
{
  const BrickFilter<T> filter(view);
  const BrickGuess guess = filter.guess(q);
  const std::uint32_t place = brick_index_of(view, vec_cast<Real>(q)).index;
  count.points++;
  count.inside += place != kNoBrick;
  if (guess.unsure) return;
  count.sure++;
  ASSERT_EQ(guess.inside, place != kNoBrick) << q.x << " " << q.y << " " << q.z;
  if (!guess.inside) return;
  ASSERT_EQ(filter.index(view, guess), place) << q.x << " " << q.y << " " << q.z;
  const CoarseTable coarse(view);
  const std::size_t nx = view.n_bricks[0], ny = view.n_bricks[1], i = place % nx,
                    j = place / nx % ny, k = place / (nx * ny),
                    side = std::size_t(1) << coarse.shift;
  ASSERT_EQ(filter.index(coarse, guess),
            ((k / side) * coarse.n[1] + j / side) * coarse.n[0] + i / side)
      << q.x << " " << q.y << " " << q.z;
}

// The side of a brick as a T, or one of its neighbours.
template <class T>
T next_to_a_side(Numbers &r, Real origin, Real side, int n)
{
  T x = static_cast<T>(origin + side * (r.below(n + 3) - 1));
  for (int steps = r.below(40); steps > 0; steps--)
    x = std::nextafter(x, static_cast<T>(r.below(4) ? HUGE_VAL : -HUGE_VAL));
  return x;
}

template <class T>
void expect_filter_is_right_wherever_it_is_sure()
{
  Numbers r(12);
  Sureness of_usual;
  const int trials = std::getenv("LSDCD_QUICK") ? 80 : 400;
  for (int trial = 0; trial < trials; trial++) {
    // Around the origin, or up to 1e6 bricks from it; from 1 to 2^22 bricks on a side.
    const Real length = r.log_in(1e-6, 1e6), side = kBrickSide * length;
    const bool usual = trial % 2 == 0;
    int n[3];
    Vec3 origin;
    for (int a = 0; a < 3; a++) {
      n[a] = 1 + static_cast<int>(r.log_in(1, usual ? 100 : 4e6));
      origin[a] = side * (usual ? -n[a] * r.in(0, 1) : (r.below(2) ? 1 : -1) * r.log_in(1, 1e6));
    }
    if (!usual && Real(n[0]) * n[1] * n[2] > 4e9) n[1] = n[2] = 3;
    const GridView view = empty_grid(origin, length, n[0], n[1], n[2]);
    Sureness next_to_sides;
    for (int i = 0; i < 10000; i++) {
      Vec3Of<T> q;
      for (int a = 0; a < 3; a++) q[a] = static_cast<T>(origin[a] + side * n[a] * r.in(-0.1, 1.1));
      expect_filter_is_right(view, q, usual ? of_usual : next_to_sides);
      const int a = r.below(3);
      q[a] = next_to_a_side<T>(r, origin[a], side, n[a]);
      expect_filter_is_right(view, q, next_to_sides);
    }
    if (::testing::Test::HasFatalFailure()) return;
  }
  // The rest costs a look at the cell.
  EXPECT_GT(of_usual.inside, of_usual.points / 3);
  EXPECT_GT(of_usual.sure, of_usual.points * 0.999);
}

TEST(query, a_brick_told_by_rounded_numbers_is_the_exact_one_where_it_is_sure)
{
  expect_filter_is_right_wherever_it_is_sure<float>();
  expect_filter_is_right_wherever_it_is_sure<double>();
}

template <class T>
void expect_filter_is_sure_of_no_number_that_is_none()
{
  Sureness count;
  for (const Real length : {0.2, 1e-30, 1e-39, 1e-44, 1e30, 1e38, 1e44})
    for (const Real far : {0., 1e4, 1e7, 1e20}) {
      const Vec3 origin = {-3 * length, far * length, -far * length};
      for (const int n : {1, 7, 64, 1 << 22, 1 << 23}) {
        const GridView view = empty_grid(origin, length, n, 2, 3);
        std::vector<T> along[3];
        for (int a = 0; a < 3; a++)
          for (Real x : hard_coordinates(origin[a], length, view.n_bricks[a]))
            along[a].push_back(static_cast<T>(x));
        for (int a = 0; a < 3; a++)
          for (T x : along[a]) {
            Vec3Of<T> q = vec_cast<T>(origin + length * Vec3{5, 5, 5});
            q[a] = x;
            expect_filter_is_right(view, q, count);
          }
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  EXPECT_GT(count.sure, count.points / 20);
  EXPECT_LT(count.sure, count.points);
}
TEST(query, a_brick_told_by_rounded_numbers_is_sure_of_no_number_that_is_none)
{
  expect_filter_is_sure_of_no_number_that_is_none<float>();
  expect_filter_is_sure_of_no_number_that_is_none<double>();
}

TEST(query, a_coarse_table_has_the_cubes_of_the_bricks_and_no_others)
{
  Numbers r(31);
  std::size_t shifts = 0;
  for (const std::array<int, 3> n : {std::array<int, 3>{1, 1, 1},
                                     {16, 16, 16},
                                     {17, 16, 16},
                                     {4096, 1, 1},
                                     {1, 4097, 1},
                                     {3, 5, 900},
                                     {64, 63, 65}}) {
    GridView view = empty_grid({0, 0, 0}, 1, n[0], n[1], n[2]);
    const std::size_t all = std::size_t(n[0]) * n[1] * n[2];
    std::vector<std::int32_t> brick_of(all, -1);
    std::int32_t bricks = 0;
    for (std::size_t at = 0; at < all; at++)
      if (at == 0 || at == all - 1 || r.below(50) == 0) brick_of[at] = bricks++;
    view.lists.brick_of = brick_of.data();

    const CoarseTable table(view);
    const std::size_t side = std::size_t(1) << table.shift, cubes = CoarseTable::kWords * 32;
    shifts += table.shift;
    ASSERT_LE(std::size_t(table.n[0]) * table.n[1] * table.n[2], cubes);
    for (int a = 0; a < 3; a++) {
      EXPECT_GE(table.n[a] * side, std::size_t(n[a]));
      EXPECT_LT((table.n[a] - 1) * side, std::size_t(n[a]));
    }
    // None of half the size would fit.
    const auto halves = [&](int n) { return (n + side / 2 - 1) / (side / 2); };
    if (side > 1) {
      EXPECT_GT(halves(n[0]) * halves(n[1]) * halves(n[2]), cubes);
    }

    std::vector<bool> taken(cubes, false);
    for (std::size_t at = 0; at < all; at++) {
      const std::size_t i = at % n[0], j = at / n[0] % n[1], k = at / (std::size_t(n[0]) * n[1]);
      if (brick_of[at] >= 0)
        taken[((k / side) * table.n[1] + j / side) * table.n[0] + i / side] = true;
    }
    const std::vector<std::uint32_t> words = coarse_words(view, table);
    ASSERT_EQ(words.size(), std::size_t(CoarseTable::kWords));
    for (std::size_t place = 0; place < cubes; place++)
      ASSERT_EQ(CoarseTable::at(words.data(), static_cast<std::uint32_t>(place)), taken[place])
          << n[0] << " " << n[1] << " " << n[2] << ": " << place;
  }
  EXPECT_GT(shifts, 0u);
}

// Wherever warps, tiles and queues of a GPU begin and end.
template <class S>
void expect_same_bits(const Case &c, const QueryGrid &grid, const std::vector<S> &spheres,
                      const std::string &what)
{
  GridQuery cpu(c, grid, Device::cpu), cuda(c, grid, Device::cuda);
  for (const std::size_t n : {1, 3, 31, 32, 33, 64, 127, 128, 129, 1000, 50001, 2000003}) {
    const std::vector<S> some(spheres.begin(), spheres.begin() + std::min(n, spheres.size()));
    const Answers a = cpu.ask(some), b = cuda.ask(some);
    EXPECT_EQ(a.status, b.status) << what << ", " << n;
    ASSERT_EQ(a.distance.size(), b.distance.size());
    EXPECT_EQ(std::memcmp(a.distance.data(), b.distance.data(), a.distance.size() * sizeof(Real)),
              0)
        << what << ", " << n;
  }
}

template <class S>
std::vector<S> as(const std::vector<Sphere> &spheres)
{
  using T = decltype(S::x);
  std::vector<S> out;
  for (const Sphere &s : spheres)
    out.push_back({static_cast<T>(s.x), static_cast<T>(s.y), static_cast<T>(s.z),
                   static_cast<T>(s.r) * T(0.999)});
  return out;
}

// n spheres of radius `cutoff`, each where `place` puts it.
template <class CellIndex>
std::vector<Sphere> many(std::size_t n, Real cutoff, const CellIndex &place)
{
  std::vector<Sphere> out;
  for (std::size_t i = 0; i < n; i++) {
    const Vec3 x = place(i);
    out.push_back({x.x, x.y, x.z, cutoff});
  }
  return out;
}

void expect_same_bits_of_all_kinds(const Case &c, const std::vector<Sphere> &spheres,
                                   const std::string &what)
{
  for (const bool in_floats : {false, true})
    for (const int nearest : {0, 2}) {
      const QueryGrid grid = c.grid(nearest, in_floats);
      expect_same_bits(c, grid, spheres, what + ", double");
      expect_same_bits(c, grid, as<FloatSphere>(spheres), what + ", float");
    }
}

// More than a tile for every warp of any GPU.
constexpr std::size_t kManySpheres = 2000003;

TEST(query, gives_the_same_bits_on_both_devices_of_any_number_of_spheres)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  Numbers r(13);
  const Case c(cylinder_mesh(40, 1, 50, 100), 1, 0.5, 0, 1);
  const Vec3 lo = c.mesh.report.lo, hi = c.mesh.report.hi;
  const auto anywhere = [&](Real past) {
    Vec3 x;
    for (int k = 0; k < 3; k++) x[k] = r.in(lo[k] - past, hi[k] + past);
    return x;
  };
  expect_same_bits_of_all_kinds(c, many(kManySpheres, 1, [&](std::size_t) { return anywhere(2); }),
                                "mixed");
  expect_same_bits(c, c.grid(0, true),
                   as<FloatSphere>(many(kManySpheres, 1,
                                        [&](std::size_t) {
                                          return Vec3{0, 0, 3 * hi.z} + anywhere(0);
                                        })),
                   "all far");
  expect_same_bits(c, c.grid(0, true),
                   as<FloatSphere>(many(kManySpheres, 1,
                                        [&](std::size_t) {
                                          Vec3 x = anywhere(0);
                                          x.z = lo.z + r.in(-0.5, 0.5);
                                          return x;
                                        })),
                   "all near");
}

TEST(query, gives_the_same_bits_on_both_devices_where_many_lists_are_long)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  // The tip of a cone of 2000 facets, with more spheres about it than a block has room for.
  Numbers r(14);
  const Case c(cone_mesh(2000, 1, 0.5), 0.2, 0.1, 0, 1);
  Vec3 tip = c.mesh.vertices[0];
  for (const Vec3 &v : c.mesh.vertices)
    if (v.z > tip.z) tip = v;
  const auto spheres = many(100003, 0.2, [&](std::size_t i) {
    return i % 7 == 0 ? tip + 0.1 * r.in_box() : tip + 0.002 * r.in_box();
  });
  expect_same_bits_of_all_kinds(c, spheres, "tip");
}

TEST(query, gives_the_same_bits_on_both_devices_in_hard_places)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  for (const Real far : {0., 4e5})
    for (const Real length : {0.1, 0.4}) {
      TriangleSoup box = box_mesh({0, 0, 0}, {4, 4, 4});
      for (Vec3 &x : box.corners) x = x + far * Vec3{1, -1, 1};
      const Case c(box, 0.4, length, 0, 1);
      const GridView view = c.grid(0).view();
      std::vector<Real> along[3];
      for (int a = 0; a < 3; a++)
        along[a] = hard_coordinates(view.origin[a], view.length, view.n_bricks[a]);
      Numbers r(15);
      const auto spheres = many(100003, 0.4, [&](std::size_t) {
        Vec3 x = box.corners[r.below(static_cast<int>(box.corners.size()))] + 0.4 * r.in_box();
        const int a = r.below(3);
        x[a] = along[a][r.below(static_cast<int>(along[a].size()))];
        return x;
      });
      expect_same_bits_of_all_kinds(c, spheres, "hard places");
    }
}

TEST(query, gives_the_same_bits_on_both_devices_of_a_table_of_millions)
{
  if (!test_on_cuda()) GTEST_SKIP() << "compares CUDA with the CPU";
  // Two small triangles far apart: a table of millions of bricks, nearly all of them empty.
  TriangleSoup two;
  for (const Real at : {0., 300.})
    for (const Vec3 &x : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}})
      two.corners.push_back(x + Vec3{at, at, at});
  const Case c(two, 0.5, 0.2, 0, 1);
  ASSERT_GT(brick_words(c.grid(0).view()).size() * 32, 2000000u);
  Numbers r(16);
  const auto spheres = many(100003, 0.5, [&](std::size_t i) {
    const Real at = r.below(2) ? 300 : 0;
    return i % 3 == 0 ? 300 * r.in_box() : Vec3{at, at, at} + 1.5 * r.in_box();
  });
  expect_same_bits_of_all_kinds(c, spheres, "large table");
}

TEST(query, float_spheres_are_answered_as_double_ones_in_the_same_places)
{
  const Case &c = all_cases()[1];
  std::vector<FloatSphere> floats;
  std::vector<Sphere> same;
  for (const Sphere &s : c.spheres) {
    floats.push_back({float(s.x), float(s.y), float(s.z), float(s.r)});
    const FloatSphere &f = floats.back();
    same.push_back({f.x, f.y, f.z, std::fmin(Real(f.r), c.cutoff)});
    floats.back().r = std::nextafter(f.r, 0.f);
    same.back().r = floats.back().r;
  }
  const QueryGrid grid = c.grid(2);
  const Answers a = ask(c, grid, floats), b = ask(c, grid, same);
  EXPECT_EQ(a.status, b.status);
  for (std::size_t i = 0; i < floats.size(); i++)
    EXPECT_EQ(a.distance[i], static_cast<float>(b.distance[i]));
}

TEST(query, one_query_answers_more_spheres_and_fewer)
{
  const Case &c = all_cases()[1];
  for (int n : {0, 2}) {
    const QueryGrid grid = c.grid(n);
    GridQuery query(c, grid);
    for (const std::size_t most : {c.spheres.size(), std::size_t(100), c.spheres.size()}) {
      const std::vector<Sphere> some(c.spheres.begin(), c.spheres.begin() + most);
      const Answers a = query.ask(some), b = ask(c, grid, some);
      EXPECT_EQ(a.status, b.status);
      EXPECT_EQ(a.distance, b.distance);
    }
  }
}

TEST(query, spheres_away_from_the_wall_certainly_touch_nothing)
{
  const Real nan = std::nan(""), inf = std::numeric_limits<Real>::infinity();
  const Case c(box_mesh({0, 0, 0}, {4, 4, 4}), 0.3, 0.1, 0, 1);
  const std::vector<Sphere> spheres = {{2, 2, 2, 0.3},   {9, 9, 9, 0.3},   {-1e300, 0, 0, 0.3},
                                       {inf, 0, 0, 0.3}, {nan, 0, 0, 0.3}, {0, nan, 0, 0.3}};
  for (int n : {0, 1}) {
    const Answers a = ask(c, c.grid(n), spheres);
    for (std::size_t i = 0; i < spheres.size(); i++) {
      EXPECT_EQ(a.status[i], kCertified) << i;
      EXPECT_EQ(a.distance[i], HUGE_VAL) << i;
    }
  }
}

// The answer of a query for the 700 spheres when those at `large` have radius r.
template <class S>
std::string refusal(const std::vector<std::size_t> &large, Real r)
{
  // Cutoff 0.1; spheres with the cutoff for their radius, far from the wall.
  const Case c(box_mesh({0, 0, 0}, {4, 4, 4}), 0.1, 0.1, 0, 1);
  const auto digits = [](Real x) { return static_cast<decltype(S::r)>(x); };
  std::vector<S> spheres(700, {2, 2, digits(3.5), digits(0.1)});
  for (std::size_t i : large) spheres[i].r = digits(r);
  return lsdcd::error_of([&] { ask(c, c.grid(0), spheres); });
}

// The sphere of radius 0.6 overlaps the wall by 0.1, where lists for 0.1 say nothing.
TEST(query, a_sphere_larger_than_the_reach_or_of_no_radius_is_refused_by_its_index_and_both_lengths)
{
  const std::string words =
      "point 600 has radius 0.6, more than the grid's cutoff 0.1: build the grid with a cutoff of "
      "the largest radius";
  EXPECT_EQ(refusal<Sphere>({600, 699}, 0.6), words);
  EXPECT_TRUE(has(refusal<Sphere>({5}, std::nan("")), "point 5 has radius nan"));
  EXPECT_EQ(refusal<FloatSphere>({}, 0), "");    // the nearest float to 0.1 is more than 0.1
  EXPECT_TRUE(has(refusal<FloatSphere>({600}, 0.1000001), "point 600 has radius 0.100000"));
}

TEST(query, asking_for_the_cell_first_refuses_large_spheres_too)
{
  const Case c(box_mesh({0, 0, 0}, {4, 4, 4}), 0.1, 0.1, 0, 1);
  EXPECT_THROW(ask_cells_first(c.grid(0), {{2, 2, 3.5, 0.6}}), InputError);
  EXPECT_NO_THROW(ask_cells_first(c.grid(0), {{2, 2, 3.5, 0.1}}));
}

TEST(query, a_sphere_that_only_reaches_the_wall_does_not_touch_it)
{
  const Case c(box_mesh({0, 0, 0}, {4, 4, 4}), 0.5, 0.25, 0, 1);
  for (int n : {0, 1, 2}) {
    const Answers a =
        ask(c, c.grid(n), std::vector<Sphere>{{2, 2, 4.25, 0.25}, {2, 2, 4.25, 0.2500001}});
    EXPECT_FALSE(a.touching(0)) << n;
    EXPECT_TRUE(a.touching(1)) << n;
    EXPECT_EQ(a.distance[1], 0.25) << n;
  }
}

}    // namespace
}    // namespace lsdcd::test_query
