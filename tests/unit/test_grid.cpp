// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "backend/threads.h"
#include "base/input_error.h"
#include "contact/find_contacts.h"
#include "grid/brick_records.h"
#include "grid/build/fill_lists.h"
#include "grid/flat_grid.h"
#include "support/brute_force.h"
#include "support/device.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#if defined(_OPENMP)
#include <omp.h>
#endif

namespace lsdcd::test_grid {
namespace {

constexpr int kMost = 256;

// Triangles between random points: edges with one, two and more faces, faces
// that cross, all angles.
TriangleSoup tangle(int n_points, int n_triangles, unsigned seed)
{
  Random random(seed);
  std::vector<Vec3> p(n_points);
  for (Vec3 &x : p) x = uniform(random, {-1, -1, -1}, {1, 1, 1});
  TriangleSoup soup;
  soup.source = "tangle";
  while (static_cast<int>(soup.corners.size()) < 3 * n_triangles) {
    const auto pick = [&] { return p[random() % p.size()]; };
    const Vec3 a = pick(), b = pick(), c = pick();
    if (norm(cross(b - a, c - a)) > 1e-3) soup.corners.insert(soup.corners.end(), {a, b, c});
  }
  return soup;
}

template <class Settings = StepGridSettings>
GridFor<Settings> grid_of(const TriangleSoup &soup, Real cutoff, Real length = 0)
{
  Settings settings;
  settings.cutoff = cutoff;
  settings.length = length;
  return build_grid(weld(soup, -1), settings, test_on_cuda());
}

// A point of the wall, or a point anywhere in the box that spheres can reach.
Vec3 query_point(Random &random, const TriangleSoup &soup, const Vec3 &lo, const Vec3 &hi,
                 Real cutoff)
{
  const std::size_t t = 3 * (random() % soup.n_triangles());
  Real u = uniform(random, 0, 1), v = uniform(random, 0, 1);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  if (random() % 8 == 0) u = 0;
  if (random() % 8 == 0) v = 0;
  const Vec3 on = soup.corners[t] + u * (soup.corners[t + 1] - soup.corners[t]) +
                  v * (soup.corners[t + 2] - soup.corners[t]);
  const Vec3 e = {cutoff, cutoff, cutoff};
  switch (random() % 4) {
    case 0:
      return uniform(random, lo - 1.5 * e, hi + 1.5 * e);
    case 1:
      return on + uniform(random, -0.01 * e, 0.01 * e);
    default:
      return on + uniform(random, -1. * e, e);
  }
}

// The same contacts through the grid as by trying every feature. Closest points that the
// tolerance lets two features report are one contact on both sides of the comparison;
// both see the same feature records, so that only rounding of q - closest point is left.
void expect_complete(const TriangleSoup &soup, Real cutoff, Real length, int n, unsigned seed)
{
  const StepGrid grid = grid_of(soup, cutoff, length);
  const GridView view = grid.view();
  Vec3 lo = soup.corners[0], hi = lo;
  for (const Vec3 &x : soup.corners)
    for (int k = 0; k < 3; k++) lo[k] = std::fmin(lo[k], x[k]), hi[k] = std::fmax(hi[k], x[k]);
  const Real far = std::fmax(norm(lo), norm(hi));
  const Real same = kSamePoint * grid.tolerance, close = 2 * same + 16 * kRoundoff * far;
  Random random(seed);
  long found = 0;
  for (int i = 0; i < n; i++) {
    const Vec3 q = query_point(random, soup, lo, hi, cutoff);
    const Real r = random() % 4 ? uniform(random, 0, cutoff) : cutoff;
    const auto expected =
        brute_contacts(view.wall, grid.wall.contact_features, q, r, grid.tolerance, same);
    ContactSet<kMost> set;
    find_contacts(view, q, r, set);
    ASSERT_FALSE(set.overflow);
    ASSERT_EQ(set.n, static_cast<int>(expected.size()))
        << "at " << q.x << " " << q.y << " " << q.z << ", radius " << r;
    found += set.n;
    for (const BruteContact &c : expected) {
      Real nearest = 1e300;
      for (int k = 0; k < set.n; k++)
        nearest = std::fmin(nearest, norm(q - set.distance[k] * set.normal[k] - c.closest));
      ASSERT_LE(nearest, close);
    }
  }
  EXPECT_GT(found, n / 4) << "the points tried nothing";
}

// Needles of length 1 round a point, 1e-3 to 1e-6 thick, folded up and down.
TriangleSoup needles()
{
  Random random(14);
  TriangleSoup soup;
  soup.source = "needles";
  for (int i = 0; i < 60; i++) {
    const Real a = uniform(random, 0, 2 * kPi), up = uniform(random, -0.5, 0.5);
    const Real thick = std::pow(10., uniform(random, -6, -3));
    const Vec3 end = {std::cos(a), std::sin(a), up};
    const Vec3 aside = {-std::sin(a) * thick, std::cos(a) * thick, uniform(random, -1, 1) * thick};
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, end, end + aside});
  }
  return soup;
}

TEST(grid, is_complete)
{
  const TriangleSoup cylinder = cylinder_mesh(40, 3, 1, 1.5), cube = box_mesh({0, 0, 0}, {1, 1, 1}),
                     free_and_nonmanifold = tangle(14, 40, 6);
  const Vec3 a_million_radii = {1e6 * 0.25, -0.7e6 * 0.25, 0.3e6 * 0.25};
  ASSERT_GT(weld(free_and_nonmanifold, -1).report.nonmanifold_edges, 0u);
  ASSERT_GT(weld(free_and_nonmanifold, -1).report.open_edges, 0u);
  const struct {
    const char *what;
    TriangleSoup soup;
    Real cutoff;
    std::vector<Real> lengths;    // of cells; 0: that of the grid
    int n;                        // spheres
  } rows[] = {
      {"a floor of two triangles", floor_mesh(1, 2), 0.3, {0}, 20000},
      {"a shuffled floor", floor_mesh(10, 1, 7), 0.3, {0}, 20000},
      {"a cylinder", cylinder, 0.25, {0}, 20000},
      {"a box", box_mesh({0, 0, 0}, {1, 2, 3}), 0.4, {0}, 20000},
      {"free and non-manifold edges", free_and_nonmanifold, 0.3, {0}, 20000},
      {"needles", needles(), 0.3, {0, 0.02, 0.3}, 10000},
      {"cells of any length", tangle(12, 20, 8), 0.2, {0.013, 0.05, 0.1, 0.29, 0.6, 3}, 4000},
      {"cells of any length on a cylinder",
       cylinder_mesh(24, 2, 0.5, 0.6),
       0.2,
       {0.013, 0.05, 0.1, 0.29, 0.6, 3},
       4000},
      {"spheres much larger than the mesh", cube, 30, {0}, 10000},
      {"spheres much smaller than the triangles", cube, 0.01, {0}, 10000},
      {"a cylinder far away", moved(cylinder, a_million_radii), 0.25, {0}, 20000},
      {"a floor far away", moved(floor_mesh(10, 1, 7), a_million_radii), 0.25, {0.04}, 20000},
  };
  for (const auto &row : rows)
    for (const Real length : row.lengths) {
      SCOPED_TRACE(row.what);
      expect_complete(row.soup, row.cutoff, length, row.n, 4);
    }
}

TEST(grid, is_complete_on_hinges_of_all_angles)
{
  for (Real degrees : {-170., -90., -1., -1e-6, 1e-9, 1e-6, 1., 30., 90., 150., 179.})
    expect_complete(hinge_mesh(degrees, 1), 0.4, 0, 4000, 5);
}

// A cube has records of its twelve edges, and none of its six diagonals.
TEST(grid, flat_edges_have_no_records)
{
  const MeshFeatures cube = make_features(weld(box_mesh({0, 0, 0}, {1, 1, 1}), -1), true);
  EXPECT_EQ(cube.edges.size(), 12u);
  EXPECT_EQ(cube.edge_out.size(), 12u);
  EXPECT_EQ(cube.edge_vertex.size(), 18u);
  EXPECT_EQ(cube.contact_features.size(), 12u + 12u + 8u);
}

// Returns the cell that is chosen, over the cutoff: of a floor of 2 n^2 triangles over [-1, 1]^2.
template <class Settings>
Real chosen(int n, Real cutoff, Settings settings)
{
  settings.cutoff = cutoff;
  return plan_grid(weld(floor_mesh(n, 1), -1), settings).length / cutoff;
}

// Edges of 0.02, and of 0.02 sqrt(2): the median is one of the former.
TEST(grid, for_a_gpu_a_cell_goes_with_the_edges_from_a_quarter_to_a_half_of_the_cutoff)
{
  StepGridSettings settings;
  settings.for_gpu = true;
  EXPECT_EQ(chosen(2, 0.25, settings), 0.5);
  EXPECT_NEAR(chosen(100, 0.1, settings), 2 * 0.02 / 0.1, 1e-12);
  EXPECT_EQ(chosen(100, 0.5, settings), 0.25);
  settings.length = 0.2;
  EXPECT_NEAR(chosen(2, 0.25, settings), 0.8, 1e-15);
}

// Points read a list each: two edges, from a tenth of the cutoff to all of it.
TEST(grid, for_points_a_cell_goes_with_the_edges)
{
  const QueryGridSettings settings;
  EXPECT_EQ(chosen(2, 0.25, settings), 1);
  EXPECT_NEAR(chosen(100, 0.1, settings), 2 * 0.02 / 0.1, 1e-12);
  EXPECT_EQ(chosen(100, 0.5, settings), 0.1);
}

TEST(grid, coarser_cells_for_a_gpu_come_to_those_of_a_cpu)
{
  const WeldedMesh mesh = weld(floor_mesh(100, 1), -1);
  StepGridSettings settings;
  settings.cutoff = 0.5;
  GridPlan of_cpu = plan_grid(mesh, settings);
  settings.for_gpu = true;
  GridPlan of_gpu = plan_grid(mesh, settings);
  while (of_gpu.length < of_cpu.length) of_gpu = coarser(of_gpu, mesh, settings);
  EXPECT_EQ(of_gpu.length, of_cpu.length);
}

// A CPU does for all cells of an octant at once what a GPU does cell by cell, to the bit: grids are the
// same on both.
TEST(grid, cells_of_a_face_at_once_are_those_found_one_by_one)
{
  std::uint64_t cells = 0;
  for (const TriangleSoup &soup : {tangle(12, 20, 8), needles(), box_mesh({0, 0, 0}, {1, 1, 1})})
    for (Real length : {0.0625, 0.1, 0.3}) {
      const WeldedMesh mesh = weld(soup, -1);
      const MeshFeatures features = make_features(mesh, false);
      StepGridSettings settings;
      settings.cutoff = 0.25;
      settings.length = length;
      const BuildView b = {features.view(), nullptr, CellTest::regions, plan_grid(mesh, settings)};
      for (std::uint32_t f = 0; f < features.faces.size(); f++) {
        const BrickBox box = brick_box(b, feature_code(FeatureKind::face, f));
        for (std::uint64_t i = 0; i < 8 * box.count(); i++) {
          const std::uint32_t octant = 8 * brick_index(b.plan, box, i / 8) + i % 8;
          const auto meets = [&](const Vec3 &c, Real around) {
            Real distance;
            return face_meets(features.faces[f], c, around + b.plan.widened(), b.plan.cutoff,
                              distance);
          };
          const std::uint64_t met = face_cells(b.plan, octant, features.faces[f]);
          ASSERT_EQ(met, cells_where(b.plan, octant, meets)) << soup.source << " " << f;
          cells += count_bits(met);
        }
      }
    }
  EXPECT_GT(cells, 100000u);
}

TEST(grid, lists_ascend_and_bounds_lie_below_the_true_distance)
{
  for (const TriangleSoup &soup : {tangle(14, 40, 6), cylinder_mesh(40, 3, 1, 1.5)}) {
    const QueryGrid grid = grid_of<QueryGridSettings>(soup, 0.3, 0.3);
    const GridView view = grid.view();
    std::size_t lists = 0;
    for (std::size_t at = 0; at < grid.lists.brick_of.size(); at++) {
      if (grid.lists.brick_of[at] < 0) continue;
      const Brick &brick = grid.lists.bricks[grid.lists.brick_of[at]];
      for (int c = 0; c < kBrickCells; c++) {
        if (!has_entries(brick, c)) continue;
        const Cell cell = grid.lists.cells[cell_index(brick, c)];
        if (cell.count == 1) continue;
        lists++;
        const std::size_t nx = grid.n_bricks[0], ny = grid.n_bricks[1];
        const Vec3 centre =
            grid.origin + grid.length * Vec3{Real(at % nx * 8 + c % 8) + 0.5,
                                             Real(at / nx % ny * 8 + c / 8 % 8) + 0.5,
                                             Real(at / nx / ny * 8 + c / 64) + 0.5};
        for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
          const CellEntry a = grid.lists.entries[i];
          // A tolerance of the whole world asks for the distance wherever the closest point is.
          ASSERT_LE(a.bound, closest_point_on(view.wall, a.feature, centre, 1e9).distance);
          if (i == cell.first) continue;
          const CellEntry before = grid.lists.entries[i - 1];
          ASSERT_TRUE(before.bound < a.bound ||
                      (before.bound == a.bound && before.feature < a.feature));
        }
      }
    }
    EXPECT_GT(lists, 100u);
  }
}

// Walls of 1 to 2^30 features of a kind, and bounds past the largest, too.
TEST(grid, a_packed_candidate_has_its_code)
{
  Random random(31);
  for (std::uint64_t n :
       {std::uint64_t(1), std::uint64_t(2), std::uint64_t(3), std::uint64_t(299884),
        std::uint64_t(1) << 29, std::uint64_t(kMaxFeatures)}) {
    const EntryPacking packing(n, 0.7);
    for (int i = 0; i < 1000; i++) {
      const FeatureKind kind = FeatureKind(random() % 3);
      const std::uint32_t last = static_cast<std::uint32_t>(n - 1),
                          index = i == 0 ? last : static_cast<std::uint32_t>(random() % n);
      const FeatureCode code = feature_code(kind, index);
      const float bound = i % 7 == 0 ? 3e38f : static_cast<float>(uniform(random, 0, 1));
      EXPECT_EQ(packing.feature(packing.pack({code, bound})), code) << n;
    }
  }
}

TEST(grid, packing_leaves_bounds_in_order)
{
  constexpr Real kInf = std::numeric_limits<Real>::infinity();
  Random random(32);
  for (std::uint64_t n : {3u, 299884u, 1u << 27, 1u << 30})
    for (Real largest : {0.7, 1e-60, 1e60}) {
      const EntryPacking packing(n, largest);
      Real before = -kInf;
      std::vector<Real> lengths = {-kInf, -1, -0., 0., 1e300, kInf};
      for (int i = 0; i < 2000; i++) lengths.push_back(uniform(random, 0, 1.2 * largest));
      std::sort(lengths.begin(), lengths.end());
      for (Real length : lengths) {
        EXPECT_LE(packing.steps(before), packing.steps(length));
        before = length;
      }
    }
}

TEST(grid, a_packed_bound_is_less_than_a_step_below_the_bound)
{
  const TriangleSoup soup = cylinder_mesh(40, 3, 1, 1.5);
  const StepGrid grid = grid_of(soup, 0.3, 0.3);
  const QueryGrid of_queries = grid_of<QueryGridSettings>(soup, 0.3, 0.3);
  const EntryPacking &packing = grid.lists.packing;
  const Real step = 1 / packing.steps_per_length;
  ASSERT_EQ(grid.lists.packed.size(), of_queries.lists.entries.size());
  ASSERT_GT(grid.lists.packed.size(), 1000u);
  EXPECT_LT(step, 1e-4 * grid.cutoff);
  for (std::size_t i = 0; i < grid.lists.packed.size(); i++) {
    const CellEntry full = of_queries.lists.entries[i];
    const std::uint32_t word = grid.lists.packed[i].word;
    // Index in the lowest bits, kind in the two top ones, as the format says.
    const Real bound = step * ((word & 0x3fffffffu) >> packing.shift);
    ASSERT_EQ((word & 0xc0000000u) | (word & ((1u << packing.shift) - 1)), full.feature);
    ASSERT_LE(bound, full.bound * (1 + 1e-12));
    ASSERT_GT(bound, full.bound - step * (1 + 1e-6));
  }
}

TEST(grid, steps_have_packed_entries_of_complete_lists_and_full_ones_of_the_nearest)
{
  const WeldedMesh mesh = weld(cylinder_mesh(40, 3, 1, 1.5), -1);
  for (const int nearest : {0, 3}) {
    StepGridSettings of_steps;
    QueryGridSettings of_queries;
    for (GridSettings *settings : {(GridSettings *) &of_steps, (GridSettings *) &of_queries}) {
      settings->cutoff = settings->length = 0.3;
      settings->nearest = nearest;
    }
    const StepGrid steps = build_grid(mesh, of_steps, test_on_cuda());
    const QueryGrid full = build_grid(mesh, of_queries, test_on_cuda());
    const bool packs = nearest == 0;
    EXPECT_EQ(steps.lists.packed.size(), packs ? full.lists.entries.size() : 0);
    EXPECT_EQ(steps.lists.entries.size(), packs ? 0 : full.lists.entries.size());
    EXPECT_EQ(full.lists.packed.size(), 0u);
  }
}

// Does the list of a cell hold a feature?
bool lists(const GridView &grid, const CellIndex &at, FeatureCode feature)
{
  const Brick *brick = brick_at(grid, at.i, at.j, at.k);
  if (!brick || !has_entries(*brick, cell_in_brick(at))) return false;
  const Cell cell = grid.lists.cells[cell_index(*brick, cell_in_brick(at))];
  if (cell.count == 1) return cell.first == feature;
  for (std::uint32_t c = cell.first; c < cell.first + cell.count; c++)
    if (grid.lists.entries[c].feature == feature) return true;
  return false;
}

TEST(grid, a_list_holds_for_centres_up_to_the_margin_from_its_cell)
{
  const TriangleSoup soup = tangle(40, 200, 17);
  const Real cutoff = 0.4;
  const QueryGrid grid = grid_of<QueryGridSettings>(soup, cutoff, 0.07);
  const GridView view = grid.view();
  ASSERT_GT(grid.margin, 0);
  Random random(18);
  long found = 0;
  const int n = std::getenv("LSDCD_QUICK") ? 50000 : 200000;
  for (int i = 0; i < n; i++) {
    const Vec3 near = query_point(random, soup, {-1, -1, -1}, {1, 1, 1}, cutoff);
    CellIndex cell = cell_index_of(view, near);
    if (!cell.inside) continue;
    // From a corner of the cell straight away from it, where the least is to spare.
    Vec3 q = grid.origin + grid.length * Vec3{Real(cell.i), Real(cell.j), Real(cell.k)};
    for (int d = 0; d < 3; d++) {
      const bool high = random() % 2;
      q[d] += high ? grid.length : 0;
      q[d] += (high ? 1 : -1) * grid.margin / std::sqrt(3.0);
    }
    for (const BruteContact &c : brute_contacts(view.wall, grid.wall.contact_features, q, cutoff,
                                                grid.tolerance, kSamePoint * grid.tolerance)) {
      found++;
      ASSERT_TRUE(lists(view, cell, c.feature)) << i;
    }
  }
  EXPECT_GT(found, n / 2);
}

// Arrays of some MB, so that they go in several parts.
TEST(grid, moved_into_a_block_is_what_is_copied_into_one)
{
  QueryGridSettings settings;
  settings.cutoff = settings.length = 0.2;
  QueryGrid grid = build_grid(weld(cylinder_mesh(256, 64, 1, 3), -1), settings);
  ASSERT_GT(grid.lists.entries.size() * sizeof(CellEntry), std::size_t(3) << 20);
  std::vector<char> copied(flat_bytes(grid)), moved(copied.size());
  flatten(grid, copied.data());
  move_flat(grid, moved.data());
  EXPECT_EQ(copied, moved);
}

// Cache files are written from it.
TEST(grid, flat_block_has_nothing_of_what_its_memory_held)
{
  const StepGrid grid = grid_of(tangle(14, 40, 6), 0.3);
  FlatGrid zeros(flat_bytes(grid)), ones(flat_bytes(grid));
  std::memset(zeros.block(), 0, zeros.bytes());
  std::memset(ones.block(), 0xff, ones.bytes());
  flatten(grid, zeros.block());
  flatten(grid, ones.block());
  EXPECT_EQ(std::memcmp(zeros.block(), ones.block(), zeros.bytes()), 0);
}

constexpr std::size_t kLargePage = 2 << 20;

TEST(grid, flat_block_lies_on_64_bytes_and_from_4_MB_on_a_large_page)
{
  for (const std::size_t bytes : {std::size_t(1), std::size_t(1000), 2 * kLargePage - 1,
                                  2 * kLargePage, 2 * kLargePage + 1, 5 * kLargePage}) {
    FlatGrid flat(bytes);
    EXPECT_EQ(flat.bytes(), bytes);
    const std::size_t align = bytes < 2 * kLargePage ? 64 : kLargePage;
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(flat.block()) % align, 0u) << bytes;
  }
}

#if defined(__linux__)
// "hg" among the flags of the mapping that begins at an address or before.
bool asks_for_large_pages(const void *at)
{
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t from = 0, to = 0;
    if (std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " ", &from, &to) == 2)
      here =
          from <= reinterpret_cast<std::uintptr_t>(at) && reinterpret_cast<std::uintptr_t>(at) < to;
    else if (here && line.rfind("VmFlags:", 0) == 0)
      return line.find(" hg") != std::string::npos;
  }
  return false;
}

TEST(grid, a_large_flat_block_asks_for_large_pages)
{
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"))
    GTEST_SKIP() << "the kernel has no transparent large pages";
  FlatGrid flat(2 * kLargePage);
  EXPECT_TRUE(asks_for_large_pages(flat.block()));
  EXPECT_TRUE(asks_for_large_pages(flat.block() + flat.bytes() - 1));
}
#endif

#if defined(_OPENMP)
TEST(grid, one_and_two_threads_build_the_same_bytes)
{
  const int before = omp_get_max_threads();
  for (const TriangleSoup &soup : {tangle(14, 40, 6), cylinder_mesh(40, 3, 1, 1.5)}) {
    omp_set_num_threads(1);
    const StepGrid one = grid_of(soup, 0.3);
    omp_set_num_threads(2);
    ASSERT_EQ(threads(), 2) << "set OMP_NUM_THREADS, or only one thread is used";
    const StepGrid two = grid_of(soup, 0.3);
    omp_set_num_threads(before);
    ASSERT_EQ(flat_bytes(one), flat_bytes(two));
    FlatGrid a(one), b(two);
    EXPECT_EQ(std::memcmp(a.block(), b.block(), flat_bytes(one)), 0);
  }
}
#endif

std::string build_error(const WeldedMesh &mesh, const StepGridSettings &settings)
{
  return lsdcd::error_of([&] { build_grid(mesh, settings, test_on_cuda()); });
}

// The number before " MB" that follows `before`, in bytes.
std::size_t named_bytes(const std::string &message, const std::string &before)
{
  const std::size_t at = message.find(before);
  if (at == std::string::npos) return 0;
  return static_cast<std::size_t>(std::stod(message.substr(at + before.size())) * 1048576);
}

TEST(grid, a_given_length_over_the_budget_is_refused_with_what_it_takes)
{
  const WeldedMesh mesh = weld(cylinder_mesh(40, 3, 1, 1.5), -1);
  for (std::size_t budget : {400u << 10, 1u << 20, 5u << 20}) {
    StepGridSettings settings;
    settings.cutoff = 0.2;
    settings.length = 0.004;
    settings.memory_budget = budget;
    const std::string message = build_error(mesh, settings);
    EXPECT_GT(named_bytes(message, "grid 0.004 takes "), budget) << message;
    EXPECT_TRUE(has(message, "leave grid out"));
    settings.length = 0;
    EXPECT_LE(flat_bytes(build_grid(mesh, settings, test_on_cuda())), budget);
  }
}

TEST(grid, the_budget_holds_for_all_that_is_shared)
{
  const WeldedMesh mesh = weld(floor_mesh(60, 1, 3), -1);
  for (const bool in_floats : {false, true}) {
    QueryGridSettings settings;
    settings.cutoff = 0.05;
    settings.memory_budget = 6 << 20;
    settings.in_floats = in_floats;
    const QueryGrid grid = build_grid(mesh, settings, test_on_cuda());
    EXPECT_LE(flat_bytes(grid), settings.memory_budget);
    EXPECT_TRUE(grid.report.length_chosen);
  }
}

TEST(grid, where_no_length_fits_a_budget_that_does_is_named)
{
  for (const TriangleSoup &soup : {floor_mesh(60, 1, 3), tangle(14, 40, 6)}) {
    const WeldedMesh mesh = weld(soup, -1);
    StepGridSettings settings;
    settings.cutoff = 0.05;
    for (const std::size_t budget : {1u << 10, 10u << 10}) {
      settings.memory_budget = budget;
      const std::string message = build_error(mesh, settings);
      settings.memory_budget = named_bytes(message, "the coarsest grid of this mesh takes ");
      ASSERT_GT(settings.memory_budget, budget) << message;
      EXPECT_EQ(build_error(mesh, settings), "") << message;
    }
  }
}

TEST(grid, the_budget_that_does_is_named_with_its_digits)
{
  TriangleSoup soup;
  soup.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  StepGridSettings settings;
  settings.cutoff = 0.5;
  settings.memory_budget = 1;
  const std::string message = build_error(weld(soup, -1), settings);
  settings.memory_budget = named_bytes(message, "the coarsest grid of this mesh takes ") - 100;
  EXPECT_NE(build_error(weld(soup, -1), settings), "") << message;
}

TEST(grid, cells_are_of_the_reach_by_default_and_smaller_for_nearest_lists)
{
  const WeldedMesh mesh = weld(floor_mesh(60, 1, 3), -1);
  StepGridSettings settings;
  settings.cutoff = 0.04;
  EXPECT_EQ(build_grid(mesh, settings, test_on_cuda()).length, settings.cutoff);
  settings.nearest = 2;
  const Real third = 0.3 * mesh.report.median_edge;
  ASSERT_LT(third, 0.5 * settings.cutoff);
  ASSERT_GT(third, 0.2 * settings.cutoff);
  EXPECT_EQ(build_grid(mesh, settings, test_on_cuda()).length, third);
}

TEST(grid, candidates_of_a_layer_are_summed_in_64_bits)
{
  CpuBackend b;
  const std::vector<std::uint32_t> counts(64, 0x80000000u);
  std::vector<std::uint32_t> offsets(64), singles(1), longests(1);
  std::vector<std::uint64_t> lists(1), cells(1);
  Brick brick;
  sum_words(b, 1, counts.data(), &brick, offsets.data(), lists.data(), cells.data(), singles.data(),
            longests.data());
  EXPECT_EQ(lists[0], std::uint64_t(1) << 37);
}

TEST(grid, more_cells_than_32_bits_number_are_not_filled)
{
  BuiltLists<CpuBackend> lists;
  lists.n_cells = 0xffffffff;
  EXPECT_TRUE(lists.can_be_numbered());
  lists.n_cells++;
  EXPECT_FALSE(lists.can_be_numbered());
}

TEST(grid, more_copies_in_floats_than_codes_number_are_refused)
{
  EXPECT_NO_THROW(check_record_number(0x3fffffff));
  EXPECT_THROW(check_record_number(0x40000000), InputError);
}

TEST(grid, hopeless_length_is_refused)
{
  StepGridSettings settings;
  settings.cutoff = 0.1;
  settings.length = 1e-12;
  settings.memory_budget = 32 << 20;
  EXPECT_THROW(build_grid(weld(box_mesh({0, 0, 0}, {1, 1, 1}), -1), settings, test_on_cuda()),
               InputError);
}

TEST(grid, pieces_very_far_apart_are_both_covered_or_refused)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {1, 1, 1});
  append(soup, moved(box_mesh({0, 0, 0}, {1, 1, 1}), {4e9, 0, 0}));
  StepGridSettings settings;
  settings.cutoff = 0.25;
  try {
    const StepGrid grid = build_grid(weld(soup, 0), settings, test_on_cuda());
    for (Real x : {0.5, 4e9 + 0.5}) {
      ContactSet<kMost> set;
      find_contacts(grid.view(), {x, 0.5, 1.125}, 0.25, set);
      EXPECT_EQ(set.n, 1);
    }
  } catch (const InputError &) {
    SUCCEED();
  }
}

TEST(grid, reach_that_is_not_a_length_is_refused)
{
  const WeldedMesh mesh = weld(box_mesh({0, 0, 0}, {1, 1, 1}), -1);
  for (Real cutoff : {0., -1., HUGE_VAL, std::nan("")}) {
    StepGridSettings settings;
    settings.cutoff = cutoff;
    EXPECT_THROW(build_grid(mesh, settings, test_on_cuda()), InputError);
  }
}

TEST(grid, points_outside_its_box_and_at_no_number_touch_nothing)
{
  // The coordinates that stay are near walls, which a point would touch if the bad one were ignored.
  const StepGrid grid = grid_of(box_mesh({0, 0, 0}, {1, 1, 1}), 0.3);
  const Real inf = std::numeric_limits<Real>::infinity();
  for (Real far : {1.35, 2.0, 10.0, 1e6, 1e12, 1e300, inf, std::nan("")})
    for (int k = 0; k < 6; k++) {
      Vec3 q = {0.9, 0.9, 0.9};
      q[k / 2] = k % 2 ? far : 1 - far;
      ContactSet<kMost> set;
      find_contacts(grid.view(), q, 0.3, set);
      EXPECT_EQ(set.n, 0);
      if (std::isnan(far)) {
        EXPECT_FALSE(locate(grid.view(), q).brick);
      }
    }
}

TEST(grid_length, that_may_coarsen_does_where_the_budget_asks_for_it)
{
  const WeldedMesh mesh = weld(cylinder_mesh(60, 25, 1, 2.5), -1);
  StepGridSettings settings;
  settings.cutoff = 0.1;
  settings.length = 0.01;
  settings.memory_budget = 2 << 20;
  EXPECT_THROW(build_grid(mesh, settings, test_on_cuda()), InputError);
  settings.may_coarsen = true;
  EXPECT_GT(build_grid(mesh, settings, test_on_cuda()).length, 0.01);
}

}    // namespace
}    // namespace lsdcd::test_grid
