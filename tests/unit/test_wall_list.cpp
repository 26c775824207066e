// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lists of the wall: what one holds, how far it holds, and what an engine does with it. Walks inside
// the margin on random meshes are in test_properties.cpp.
#include "base/input_error.h"
#include "engine/step/narrow_phase.h"
#include "support/brute_force.h"
#include "support/crowd.h"
#include "support/kept_springs.h"
#include "support/laws.h"
#include "support/random_mesh.h"
#include "support/sphere_arrays.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace lsdcd::test_wall_list {
namespace {

struct Wall {
  WeldedMesh mesh;
  StepGrid grid;
  FlatOf<StepGrid> flat;

  Wall(const TriangleSoup &soup, Real cutoff) : mesh(weld(soup, -1))
  {
    StepGridSettings g;
    g.cutoff = cutoff;
    grid = build_grid(mesh, g);
    flat = FlatOf(grid);
  }
  ViewOf<StepGrid> view() const { return flat.view(); }
};

// The list of a sphere that feels the wall as far as `cutoff`, as a column of its own.
class OneList {
 public:
  OneList(const GridView &grid, const Vec3 &q, Real radius, Real cutoff)
  {
    has_list = gather(Warp<1>(), true, grid, {q, radius, cutoff, nullptr, 0}, kAnyDistance, made);
    lists.put(0, made, grid.wall);
  }
  OneList(const GridView &grid, const Vec3 &q, Real radius) : OneList(grid, q, radius, radius) {}
  bool holds(const Vec3 &q, Real cutoff) const { return lists.holds(0, q, cutoff); }
  Real margin() const { return lists.margin(0); }

  FeatureList made;
  bool has_list;

 private:
  Real reals_[FeatureLists::kReals];
  std::int32_t ints_[FeatureLists::kInts];
  FeatureLists lists = FeatureLists::of(reals_, ints_, 1, 1);
};

template <class Record>
bool same_record(const Record &a, const Record &b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(wall_list, keeps_copies_of_the_records_that_it_names_while_there_is_room)
{
  const Wall box(box_mesh({2, 2, 2}, {3, 3, 3}), 0.5);
  const MeshFeaturesView wall = box.view().wall;
  std::vector<FeatureCode> codes;
  for (FeatureKind kind : {FeatureKind::face, FeatureKind::edge, FeatureKind::vertex})
    for (std::uint32_t i = 0; i < 2; i++) codes.push_back(feature_code(kind, i));
  FeatureRecord records[8];
  RecordCopies::Range ranges[3] = {};
  int used = 0;
  const RecordCopies copies = {records, ranges, &used, 8};
  const auto has = [&](std::size_t k, int i, FeatureCode code) {
    const FeatureRecord *copy = copies.of(k, i);
    if (!copy) return false;
    const std::uint32_t at = feature_index(code);
    switch (feature_kind(code)) {
      case FeatureKind::face:
        return same_record(copy->face, wall.faces[at]);
      case FeatureKind::edge:
        return same_record(copy->edge, wall.edges[at]);
      default:
        return same_record(copy->vertex, wall.vertices[at]);
    }
  };
  const auto put = [&](std::size_t k, int from, int n) { copies.put(k, wall, &codes[from], n); };
  put(0, 0, 6);
  for (int i = 0; i < 6; i++) EXPECT_TRUE(has(0, i, codes[i])) << i;
  EXPECT_FALSE(copies.of(0, 6));
  put(1, 4, 2);
  EXPECT_TRUE(has(1, 0, codes[4]) && has(1, 1, codes[5]));
  // No room: the wall's own, also where there was a copy.
  put(2, 0, 1);
  put(1, 0, 3);
  EXPECT_FALSE(copies.of(2, 0) || copies.of(1, 0));
  // A shorter list takes the room of the longer one.
  put(0, 3, 2);
  EXPECT_TRUE(has(0, 0, codes[3]) && has(0, 1, codes[4]));
  EXPECT_FALSE(copies.of(0, 2));
  put(1, 1, 2);
  EXPECT_TRUE(has(1, 0, codes[1]) && has(1, 1, codes[2]));
}

Vec3 in_grid(Numbers &r, const GridView &grid)
{
  Vec3 q;
  for (int d = 0; d < 3; d++)
    q[d] = grid.origin[d] + r.in(0, grid.n_bricks[d]) * kBrickSide * grid.length;
  return q;
}

// ---- one list ----------------------------------------------------------------------------------

TEST(wall_list, is_ascending_and_without_doubles)
{
  const Wall wall(random_soup(100, 3), 0.5);
  Numbers r(1);
  int several = 0;
  for (int k = 0; k < 5000; k++) {
    const FeatureList made = OneList(wall.view(), in_grid(r, wall.view()), 0.5).made;
    several += made.n > 1;
    for (int i = 1; i < made.n; i++) ASSERT_LT(made.code[i - 1], made.code[i]);
  }
  EXPECT_GT(several, 50);
}

const Vec3 kOverFloor = {0.31, 0.17, 0.4};

TEST(wall_list, holds_as_far_as_its_margin_and_no_farther)
{
  const Wall wall(floor_mesh(4, 2), 0.5);
  const OneList list(wall.view(), kOverFloor, 0.5);
  ASSERT_TRUE(list.has_list);
  // It is rounded down, by 1e-6 and to a float.
  EXPECT_LE(list.margin(), kSkinFraction * 0.5);
  EXPECT_GE(list.margin(), kSkinFraction * 0.5 * (1 - 1.1e-6));
  Numbers r(2);
  for (int k = 0; k < 1000; k++) {
    const Vec3 way = list.margin() * r.direction();
    EXPECT_TRUE(list.holds(kOverFloor + (1 - 1e-12) * way, 0.5));
    EXPECT_FALSE(list.holds(kOverFloor + (1 + 1e-12) * way, 0.5));
  }
}

TEST(wall_list, does_not_hold_for_a_larger_cutoff)
{
  const Wall wall(floor_mesh(4, 2), 0.5);
  const OneList list(wall.view(), kOverFloor, 0.3, 0.4);
  EXPECT_TRUE(list.holds(kOverFloor, 0.4));
  EXPECT_FALSE(list.holds(kOverFloor, 0.4 * (1 + 2e-6)));    // it is rounded up, by 1e-6
}

TEST(wall_list, does_not_hold_where_the_centre_is_not_a_number)
{
  const Wall wall(floor_mesh(4, 2), 0.5);
  const Vec3 nowhere = {std::nan(""), 0, 0};
  EXPECT_FALSE(OneList(wall.view(), kOverFloor, 0.5).holds(nowhere, 0.5));
  EXPECT_FALSE(OneList(wall.view(), nowhere, 0.5).holds(nowhere, 0.5));
}

// Inside of a cone, next to its tip: all facets are at one distance from the axis.
Vec3 on_axis(Real off, Real angle = 0.1)
{
  return {off * std::cos(angle), off * std::sin(angle), -0.2};
}

TEST(wall_list, has_a_smaller_margin_where_more_than_seven_features_are_close)
{
  for (int n : {10, 50, 200}) {
    const Wall wall(cone_mesh(n, 1, 1), 0.4);
    int shrunk = 0;
    for (Real off = 1e-4; off < 0.2; off *= 1.1) {
      const OneList list(wall.view(), on_axis(off), 0.2);
      shrunk += list.has_list && list.margin() < 0.9 * kSkinFraction * 0.2;
    }
    EXPECT_GT(shrunk, 0) << n;
  }
}

TEST(wall_list, is_none_where_a_sphere_touches_more_than_seven)
{
  for (int n : {10, 50, 200}) {
    const Wall wall(cone_mesh(n, 1, 1), 0.4);
    const OneList list(wall.view(), on_axis(0), 0.2);
    EXPECT_FALSE(list.has_list) << n;
    EXPECT_EQ(list.made.n, 0) << n;
    EXPECT_FALSE(list.holds(on_axis(0), 0.2)) << n;
  }
}

TEST(wall_list, of_a_sphere_outside_of_the_grid_is_empty_and_holds)
{
  const Wall wall(floor_mesh(4, 2), 0.5);
  for (Real far : {10., -10., 1e6}) {
    const OneList list(wall.view(), {far, far, far}, 0.5);
    EXPECT_TRUE(list.has_list) << far;
    EXPECT_EQ(list.made.n, 0) << far;
    EXPECT_TRUE(list.holds({far, far, far}, 0.5)) << far;
  }
}

// At the rim of the grid, where the ball of the margin meets cells that are not there.
TEST(wall_list, at_the_rim_of_the_grid_has_what_is_inside)
{
  Wall wall(floor_mesh(4, 2), 0.5);
  StepGridSettings g;
  g.cutoff = 0.5;
  g.within = {{-1, -1, 0}, {1, 1, 1}};    // the floor itself is the rim
  wall.grid = build_grid(wall.mesh, g);
  wall.flat = FlatOf(wall.grid);
  const GridView grid = wall.view();
  for (Real up : {0., 1e-15, 1e-9, 0.01, 0.4}) {
    const Real z = std::max(up, grid.origin.z);
    ASSERT_LE(z, 0.4);
    ContactSet<8> cells;
    find_contacts(grid, {0.31, 0.17, z}, 0.5, cells);
    const OneList list(grid, {0.31, 0.17, z}, 0.5);
    ASSERT_EQ(cells.n, 1);
    if (list.has_list) {
      EXPECT_GE(list.made.n, 1) << up;
    }
  }
}

// ---- in an engine ------------------------------------------------------------------------------

// Spheres on a wall and an engine that keeps its lists from step to step.
struct Bed : SphereArrays {
  std::unique_ptr<WallEngine> engine;

  Bed(const Wall &wall, const EngineSettings &settings) : engine(on_cpu(settings))
  {
    engine->set_grid(wall.view());
  }
  void add(const Vec3 &at, Real r)
  {
    SphereArrays::add(at, r, 1, {0.1, 0.1, 0.1}, {0.1, 0.1, 0.1});
  }
  Vec3 centre(int i) const { return vector_at(x, i); }
  void put(int i, const Vec3 &at) { put_vector(x, i, at); }

  void choose(Real margin) { engine->choose(spheres(), margin); }
  void step()
  {
    clear_forces();
    StepSettings s;
    s.dt = 1e-4;
    engine->step(spheres(), s);
  }
  Vec3 force_on(int i) const { return vector_at(force, i); }
  std::vector<Spring> springs()
  {
    ContactHistory store;
    engine->springs().to_cpu(store, n());
    std::vector<Spring> all;
    for (int i = 0; i < n(); i++)
      for (const Spring &spring : springs_of(store, i)) all.push_back(spring);
    return all;
  }
};

// A cutoff that grew with each new list would hide that a sphere has grown, and make lists longer.
TEST(wall_list, that_is_made_anew_a_thousand_times_has_the_cutoff_of_the_choice)
{
  const Wall wall(floor_mesh(4, 2), 0.5);
  Bed bed(wall, hooke(1e3));
  bed.add(kOverFloor, 0.42);
  bed.choose(0.1);
  for (int k = 0; k < 1000; k++) {
    bed.put(0, kOverFloor + Vec3{k % 2 ? 0 : 0.05, 0, 0});
    bed.step();
  }
  EXPECT_EQ(bed.engine->read_diagnostics().lists, 1001);    // and that of the choice
  bed.radius[0] *= 1 + 5e-6;
  bed.step();
  EXPECT_THROW(bed.engine->read_diagnostics(), InputError);
}

TEST(wall_list, spheres_without_one_touch_what_all_features_say)
{
  const Real k = 1e3, radius = 0.2;
  for (int n : {10, 50, 200}) {
    const Wall wall(cone_mesh(n, 1, 1), 0.4);
    EngineSettings s = hooke(k);
    s.corner = Corner::sum;
    Bed bed(wall, s);
    for (Real off = 1e-4; off < 0.1; off *= 1.5)
      for (Real angle : {0., 0.1, 1., 4.}) bed.add(on_axis(off, angle), radius);
    bed.add(on_axis(0), radius);
    bed.choose(0);
    bed.step();
    const StepDiagnostics diagnostics = bed.engine->read_diagnostics();
    EXPECT_GT(diagnostics.by_cells, 0) << n;
    EXPECT_LT(diagnostics.by_cells, bed.n()) << n;    // others have one
    std::int64_t contacts = 0;
    for (int i = 0; i < bed.n(); i++) {
      const Vec3 q = bed.centre(i);
      Vec3 sum = {0, 0, 0};
      const auto all = brute_contacts(wall.view().wall, wall.grid.wall.contact_features, q, radius,
                                      wall.grid.tolerance, kSamePoint * wall.grid.tolerance);
      for (const BruteContact &c : all)
        sum += (k * (radius - c.distance) / c.distance) * (q - c.closest);
      contacts += static_cast<std::int64_t>(all.size());
      // A closest point is the centre less its distance along its normal: three roundings of lengths below
      // 1, and its share of the force is k times that.
      const Real tolerance = 8 * kRoundoff * k * static_cast<Real>(all.size());
      EXPECT_LE(norm(bed.force_on(i) - sum), tolerance) << n << ", sphere " << i;
    }
    EXPECT_EQ(bed.engine->results().totals().contacts, contacts) << n;
  }
}

TEST(wall_list, counts_lists_and_their_features)
{
  const Wall wall(floor_mesh(10, 5, 3), 0.5);
  Bed bed(wall, hooke(1e3));
  Numbers r(6);
  std::int64_t features = 0;
  for (int i = 0; i < 200; i++) {
    bed.add({r.in(-4, 4), r.in(-4, 4), r.in(0.3, 0.45)}, 0.5);
    features += OneList(wall.view(), bed.centre(i), 0.5).made.n;
  }
  bed.choose(0.2);
  ASSERT_EQ(bed.engine->n_candidates(), 200);
  bed.step();
  StepDiagnostics diagnostics = bed.engine->read_diagnostics();
  EXPECT_EQ(diagnostics.lists, 200);
  EXPECT_EQ(diagnostics.listed, features);
  EXPECT_EQ(diagnostics.by_cells, 0);

  bed.step();    // nothing has moved
  diagnostics = bed.engine->read_diagnostics();
  EXPECT_EQ(diagnostics.lists, 0);
  EXPECT_EQ(diagnostics.listed, 0);
}

TEST(wall_list, is_made_anew_for_the_sphere_that_left_its_margin_alone)
{
  const Wall wall(floor_mesh(10, 5, 3), 0.5);
  Bed bed(wall, hooke(1e3));
  Numbers r(6);
  for (int i = 0; i < 50; i++) bed.add({r.in(-4, 4), r.in(-4, 4), 0.4}, 0.5);
  bed.choose(0.2);
  bed.step();
  bed.engine->read_diagnostics();
  const Real margin = kSkinFraction * 0.5;
  bed.put(3, bed.centre(3) + Vec3{1.001 * margin, 0, 0});
  bed.put(4, bed.centre(4) + Vec3{0.999 * margin, 0, 0});
  bed.step();
  const StepDiagnostics diagnostics = bed.engine->read_diagnostics();
  EXPECT_EQ(diagnostics.lists, 1);
  EXPECT_EQ(diagnostics.listed, OneList(wall.view(), bed.centre(3), 0.5).made.n);
}

// The distance of a point outside of a box about the origin.
Real distance_from_box(const Vec3 &q, Real half)
{
  Vec3 past;
  for (int d = 0; d < 3; d++) past[d] = std::max(std::fabs(q[d]) - half, Real(0));
  return norm(past);
}

// The margins are larger than that of the lists of cells, so that other cells than the sphere's own
// have to be looked at. Rounding moves a distance by less than 1e-12.
TEST(wall_list, a_sphere_is_near_wherever_the_wall_is_within_its_cutoff_and_the_margin)
{
  constexpr Real kHalf = 1, kCutoff = 0.5;
  const Wall box(box_mesh({-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf}), kCutoff);
  const GridView grid = box.view();
  Numbers r(17);
  int missed = 0, near = 0, far = 0;
  for (int i = 0; i < 100000; i++) {
    const Vec3 q = r.in(kHalf, 2.5) * r.direction();
    const Real cutoff = kCutoff * r.in(0.2, 1), margin = grid.length * r.in(0.1, 1);
    const bool found = can_touch(Warp<1>(), true, grid, {q, cutoff, cutoff, nullptr, 0}, margin);
    const Real d = distance_from_box(q, kHalf);
    missed += !found && d > 0 && d < cutoff + margin - 1e-12;
    near += found;
    far += !found;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);
}

TEST(wall_list, a_sphere_that_cannot_touch_anything_by_its_own_radius_is_not_near)
{
  const Wall wall(floor_mesh(10, 5, 3), 0.5);
  Bed bed(wall, hooke(1e3));
  bed.add({0.31, 0.17, 0.4}, 0.3);
  bed.add({0.31, 0.67, 0.4}, 0.5);
  bed.choose(0.05);
  EXPECT_EQ(bed.engine->n_candidates(), 1);
}

TEST(wall_list, a_sphere_that_shrinks_may_grow_to_what_it_was_at_the_choice)
{
  const Wall wall(floor_mesh(10, 5, 3), 0.5);
  Bed bed(wall, hooke(1e3));
  bed.add({0.31, 0.17, 0.49}, 0.5);
  bed.choose(0.2);
  bed.step();
  // Past the margin of its list, which is made again while it is smaller.
  bed.radius[0] = 0.495;
  bed.put(0, {0.37, 0.17, 0.49});
  bed.step();
  bed.radius[0] = 0.5;
  bed.step();
  EXPECT_NO_THROW(bed.engine->read_diagnostics());
}

TEST(wall_list, of_a_sphere_that_comes_in_from_outside_of_the_grid_is_made_in_time)
{
  const Wall wall(floor_mesh(10, 5, 3), 0.5);
  EngineSettings s = hooke(1e3);
  Bed kept(wall, s), anew(wall, s);
  const Vec3 outside = {-9, -9, 5.4};
  kept.add(outside, 0.5);
  anew.add(outside, 0.5);
  EXPECT_FALSE(cell_index_of(wall.view(), outside).inside);
  kept.choose(12);
  ASSERT_EQ(kept.engine->n_candidates(), 1);
  // To a place over the floor, a third of a margin a step.
  const Vec3 way = Vec3{-0.5, -0.5, 0.4} - outside;
  const int steps = static_cast<int>(norm(way) / (kSkinFraction * 0.5 / 3));
  int touching = 0;
  for (int k = 0; k <= steps; k++) {
    kept.put(0, outside + (static_cast<Real>(k) / steps) * way);
    anew.x = kept.x;
    kept.step();
    anew.choose(0);
    anew.step();
    EXPECT_TRUE(kept.force_on(0) == anew.force_on(0)) << k;
    touching += kept.force_on(0).z > 0;
  }
  EXPECT_GT(touching, 3);
}

// Contacts are taken in the order of their numbers, so that forces and springs do not tell when a
// list was made. In a dense soup some spheres have no list and ask their cells.
TEST(wall_list, that_is_kept_on_a_walk_gives_the_bits_of_choosing_in_each_step)
{
  constexpr int kSteps = 200, kSpheres = 40;
  const Real cutoff = 0.5, step = 0.3 * kSkinFraction * cutoff;
  const Wall wall(random_soup(2000, 3), cutoff);
  EngineSettings s;
  s.law() = classic(NormalModel::hertz, true);
  Bed kept(wall, s), anew(wall, s);
  Numbers r(8);
  const std::vector<VertexRecord> &vertices = wall.grid.wall.vertices;
  for (int i = 0; i < kSpheres; i++) {
    const Vec3 at = vertices[r.next() % vertices.size()].position;
    const Vec3 q = at + r.in(0.5, 0.9) * cutoff * r.direction();
    const Real radius = cutoff * r.in(0.8, 1);
    kept.add(q, radius);
    anew.add(q, radius);
  }
  kept.choose(kSteps * step);    // no walk goes farther
  std::int64_t contacts = 0, lists = 0, by_cells = 0;
  int differ = 0;
  for (int k = 0; k < kSteps; k++) {
    for (int i = 0; i < kSpheres; i++) kept.put(i, kept.centre(i) + step * r.direction());
    anew.x = kept.x;
    kept.step();
    anew.choose(0);
    anew.step();
    contacts += kept.engine->results().totals().contacts;
    const StepDiagnostics seen = kept.engine->read_diagnostics();
    lists += seen.lists;
    by_cells += seen.by_cells;
    differ += !same_bytes(kept.force, anew.force) || !same_bytes(kept.torque, anew.torque);
  }
  EXPECT_EQ(differ, 0);
  EXPECT_TRUE(same_bytes(kept.springs(), anew.springs()));
  EXPECT_GT(contacts, kSteps * kSpheres / 2);
  EXPECT_GT(by_cells, kSteps * kSpheres / 20);
  EXPECT_LT(lists - by_cells, kSteps * kSpheres / 4);    // the others are kept
}

}    // namespace
}    // namespace lsdcd::test_wall_list
