// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The gain and cost of settings: the front, the moving spheres, the rows.
#include "study/tradeoff.h"

#include "grid/flat_grid.h"
#include "study/drift.h"
#include "study/sample_timer.h"
#include "support/device.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace lsdcd::test_tradeoff {
namespace {

TradeoffRow row_of(Real mean, double ns, bool on_cuda = false)
{
  TradeoffRow row = {};
  row.error.mean = mean;
  row.times.step.add(ns);
  row.on_cuda = on_cuda;
  return row;
}

std::vector<bool> front_of(std::vector<TradeoffRow> rows)
{
  mark_front(rows);
  std::vector<bool> front;
  for (const TradeoffRow &row : rows) front.push_back(row.on_front);
  return front;
}

TEST(front, of_each_device_holds_what_nothing_else_beats_and_equals)
{
  using Front = std::vector<bool>;
  EXPECT_EQ(front_of({row_of(0, 100), row_of(0, 90), row_of(0.1, 50), row_of(0.1, 60),
                      row_of(0.2, 90), row_of(0.5, 40)}),
            (Front{false, true, true, false, false, true}));
  EXPECT_EQ(front_of({row_of(0, 100), row_of(0, 100)}), (Front{true, true}));
  EXPECT_EQ(front_of({row_of(0, 100), row_of(0, 5, true), row_of(0.1, 6, true)}),
            (Front{true, true, false}));
}

// ---- the words for a bound -------------------------------------------------------------

TradeoffRow setting(int nearest, Real largest, double ns)
{
  TradeoffRow row = {};
  row.choice = {0.5, nearest};
  row.error.contacts = 1000;
  row.error.largest = largest;
  row.times.step.add(ns);
  return row;
}

std::string words_below(Real bound, const std::vector<TradeoffRow> &rows)
{
  const TradeoffRow *row = fastest_below(rows, bound, false);
  return row ? words_of(row->choice) : "none";
}

TEST(below, the_fastest_setting_is_taken_whose_errors_are_below_the_bound)
{
  const TradeoffRow exact = setting(0, 0, 100);
  TradeoffRow misses = setting(8, 0, 50), uncertain = setting(8, 0, 50), sum = setting(8, 0, 50),
              gpu = sum;
  misses.error.missed = 2;    // of 1000
  uncertain.error.uncertified = 1;
  sum.corner = Corner::sum;
  gpu.on_cuda = true;
  const struct {
    const char *what;
    Real bound;
    TradeoffRow other;
    bool takes_it;
  } rows[] = {{"the fastest", 1e-3, setting(8, 1e-6, 50), true},
              {"of times a tenth apart the more exact", 1e-3, setting(8, 1e-6, 92), false},
              {"an error of a force that is not below", 1e-3, setting(8, 1e-3, 50), false},
              {"a share of missed contacts that is not below", 2e-3, misses, false},
              {"one that is", 3e-3, misses, true},
              {"certified answers", 0.5, setting(8, 0, 50), true},
              {"uncertified ones", 0.5, uncertain, false},
              {"corner sum", 1e-3, sum, false},
              {"another device", 1e-3, gpu, false}};
  for (const auto &row : rows)
    EXPECT_EQ(words_below(row.bound, {exact, row.other}),
              row.takes_it ? "grid 0.5 nearest 8" : "grid 0.5 nearest all")
        << row.what;
  EXPECT_EQ(words_below(1e-3, {sum, gpu}), "none");
}

// ---- moving spheres --------------------------------------------------------------------

struct Wall {
  WeldedMesh mesh;
  StepGrid grid;

  Wall(const TriangleSoup &soup, Real cutoff, int nearest = 0) : mesh(weld(soup, -1))
  {
    StepGridSettings settings;
    settings.cutoff = cutoff;
    settings.nearest = nearest;
    grid = build_grid(mesh, settings);
  }
  DriftStarts starts(Real radius, int n) const
  {
    Random random(11);
    StepGridSettings settings;
    settings.cutoff = radius;
    return drift_starts(mesh, build_grid(mesh, settings).view(), radius, n, random);
  }
};

// The starts for which keep(point, normal) is true.
template <class Keep>
DriftStarts those(DriftStarts all, const Keep &keep)
{
  DriftStarts out;
  for (int i = 0; i < all.n(); i++) {
    if (!keep(all.point[i], all.normal[i])) continue;
    out.point.push_back(all.point[i]);
    out.normal.push_back(all.normal[i]);
    out.along.push_back(all.along[i]);
  }
  out.radius = all.radius;
  out.wall = std::move(all.wall);
  return out;
}

TEST(drift_starts, touch_the_wall_where_they_stand_and_nowhere_else)
{
  const Wall box(box_mesh({0, 0, 0}, {4, 3, 2}), 0.5);
  const DriftStarts starts = box.starts(0.5, 60);
  ASSERT_EQ(starts.n(), 60);
  long inside = 0;
  for (int i = 0; i < starts.n(); i++) {
    const Vec3 p = starts.point[i], n = starts.normal[i], x = p + 0.5 * n;
    EXPECT_NEAR(norm(n), 1, 1e-14);
    EXPECT_NEAR(dot(n, starts.along[i]), 0, 1e-14);
    // The distance from x to the box's surface, by hand: from inside that to the nearest face.
    const Vec3 q = {std::clamp(x.x, 0., 4.), std::clamp(x.y, 0., 3.), std::clamp(x.z, 0., 2.)};
    const bool in = q == x;
    const Real distance = in ? std::min({x.x, 4 - x.x, x.y, 3 - x.y, x.z, 2 - x.z}) : norm(x - q);
    EXPECT_NEAR(distance, 0.5, 1e-3);
    inside += in;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, 50);
}

// Ten bounces: velocity Verlet with 100 steps per contact errs by less than (pi / 100)^2 / 4 at each impact. Rolling on a
// plane is steady motion at constant overlap: rounding only.
TEST(drift, is_none_on_a_plane_whatever_its_triangles)
{
  for (int n : {1, 30}) {
    const Wall floor(floor_mesh(n, 30, n), 1);
    const DriftStarts starts = floor.starts(1, 20);
    EXPECT_LT(bounce_drift(floor.grid.view(), EngineSettings(), starts), 2.5e-3);
    EXPECT_LT(roll_drift(floor.grid.view(), EngineSettings(), starts), 1e-9);
  }
}

TEST(roll, loses_energy_in_a_drum_whose_seams_count_twice)
{
  const Wall drum(cylinder_mesh(1000, 1, 10, 20), 1);
  const DriftStarts starts = those(drum.starts(1, 60), [](const Vec3 &p, const Vec3 &n) {
    return n.x * p.x + n.y * p.y < -1;    // inside of the mantle
  });
  EngineSettings blend, sum;
  sum.corner = Corner::sum;
  EXPECT_GT(roll_drift(drum.grid.view(), sum, starts),
            3 * roll_drift(drum.grid.view(), blend, starts));
}

TEST(drift, is_large_where_contacts_are_missed)
{
  const TriangleSoup soup = floor_mesh(60, 10, 1);    // triangles a third of a radius
  const Wall whole(soup, 1), short_lists(soup, 1, 1);
  const DriftStarts starts = whole.starts(1, 20);
  EXPECT_GT(roll_drift(short_lists.grid.view(), EngineSettings(), starts), 0.01);
  EXPECT_LT(roll_drift(whole.grid.view(), EngineSettings(), starts), 1e-9);
}

// A ball of radius 4 about the origin: an octahedron's faces cut into n^2 and blown up.
TriangleSoup ball_mesh(int n)
{
  TriangleSoup soup;
  soup.source = "ball";
  for (int octant = 0; octant < 8; octant++) {
    const auto corner = [&](int i, int j) {
      Vec3 p = {Real(i), Real(j), Real(n - i - j)};
      for (int k = 0; k < 3; k++)
        if (octant >> k & 1) p[k] = -p[k];
      return (4 / norm(p)) * p;
    };
    const auto add = [&](const Vec3 &a, const Vec3 &b, const Vec3 &c) {
      soup.corners.insert(soup.corners.end(), {a, b, c});
    };
    for (int i = 0; i < n; i++)
      for (int j = 0; i + j < n; j++) {
        add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
        if (i + j + 1 < n) add(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
  }
  return soup;
}

// By the end every sphere that starts on its outside has slid off.
DriftStarts starts_outside(const Wall &ball)
{
  return those(ball.starts(1, 40), [](const Vec3 &p, const Vec3 &n) { return dot(n, p) > 0; });
}

// The integrator's error, as on a plane; impacts after a slide are faster, but few.
TEST(drift, is_small_on_a_convex_wall_that_spheres_leave_but_where_contacts_are_missed)
{
  const Wall ball(ball_mesh(8), 1), short_lists(ball_mesh(8), 1, 1);
  const DriftStarts starts = starts_outside(ball);
  EXPECT_LT(bounce_drift(ball.grid.view(), EngineSettings(), starts), 2.5e-3);
  EXPECT_LT(roll_drift(ball.grid.view(), EngineSettings(), starts), 0.01);
  EXPECT_GT(bounce_drift(short_lists.grid.view(), EngineSettings(), starts), 0.1);
  EXPECT_GT(roll_drift(short_lists.grid.view(), EngineSettings(), starts), 0.1);
}

TEST(drift, is_none_of_spheres_that_fall_off_an_edge)
{
  // A tile that every sphere leaves at once.
  const Wall tile(floor_mesh(1, 0.2), 1);
  EXPECT_LT(bounce_drift(tile.grid.view(), EngineSettings(), tile.starts(1, 20)), 2.5e-3);
}

TEST(drift, is_one_for_spheres_that_fall_through_the_wall)
{
  const Wall floor(floor_mesh(1, 30), 1);
  StepGridSettings nowhere;
  nowhere.cutoff = 1;
  nowhere.within = {{100, 100, 100}, {101, 101, 101}};
  const StepGrid blind = build_grid(floor.mesh, nowhere);
  EXPECT_EQ(bounce_drift(blind.view(), EngineSettings(), floor.starts(1, 20)), 1);
  EXPECT_EQ(roll_drift(blind.view(), EngineSettings(), floor.starts(1, 20)), 1);
}

// ---- times -----------------------------------------------------------------------------

TEST(spread, has_the_smallest_and_the_largest)
{
  Spread spread;
  for (double ns : {3., 2., 5., 4.}) spread.add(ns);
  EXPECT_EQ(spread.least, 2);
  EXPECT_EQ(spread.most, 5);
}

// Spheres of radius 1 in rows above a plane of two triangles, as far from its rim as they go: at most 0.2.
TEST(sample_timer, keeps_a_list_of_one_entry_over_one_triangle)
{
  const Wall floor(floor_mesh(1, 30), 1);
  SphereSample sample;
  for (int i = 0; i < 20; i++)
    for (int j = 0; j < 20; j++) sample.add({2 + 0.1 * i, -4 + 0.1 * j, 0.9}, 1);
  const FlatOf flat(floor.grid);
  const auto timer = make_sample_timer(test_on_cuda(), sample);
  EngineSettings settings;
  settings.law().k_normal = 1;
  EXPECT_EQ(timer->steps(flat.view(), settings, 1).listed, 1);
}

// ---- rows ------------------------------------------------------------------------------

Tradeoff small(double seconds = 1e9, std::size_t memory = std::size_t(1) << 30)
{
  TradeoffSettings settings;
  settings.radii = {0.4, 0.5};
  settings.spheres = 2000;
  settings.moving = 4;
  settings.repeats = 1;
  settings.seconds = seconds;
  settings.memory_budget = memory;
  settings.cpu = !test_on_cuda();
  settings.cuda = test_on_cuda();
  return measure_tradeoff(weld(cylinder_mesh(24, 4, 3, 4), -1), settings,
                          [](const TradeoffRow &) {});
}

TEST(tradeoff, has_a_row_for_every_setting_the_default_first_RELEASE)
{
  const Tradeoff t = small();
  EXPECT_TRUE(t.left_out.empty());
  std::set<std::tuple<Real, int, int>> seen;
  std::set<Real> lengths;
  for (const TradeoffRow &r : t.rows) {
    lengths.insert(r.choice.length);
    EXPECT_TRUE(
        seen.insert({r.choice.length, r.choice.nearest, static_cast<int>(r.corner)}).second);
    EXPECT_EQ(r.on_cuda, test_on_cuda());
    for (const Spread &time : {r.search, r.times.step, r.times.choice}) {
      EXPECT_GT(time.least, 0);
      EXPECT_GE(time.most, time.least);
    }
    // Complete lists are kept by sphere, those of the nearest triangles are not.
    EXPECT_EQ(r.times.listed > 0, r.choice.nearest == 0);
    EXPECT_GT(r.times.kept_bytes, 0u);
    EXPECT_GT(r.error.contacts, 200);
    if (r.choice.nearest == 0) {
      EXPECT_EQ(r.error.missed, 0);
      EXPECT_LT(r.error.largest, 1e-12);
    }
  }
  EXPECT_GE(lengths.size(), 2u);
  EXPECT_EQ(t.rows.size(), lengths.size() * std::size(kTriedNearest) * 2);
  EXPECT_TRUE(t.rows[0].is_default);
  EXPECT_EQ(std::count_if(t.rows.begin(), t.rows.end(), [](const auto &r) { return r.is_default; }),
            1);
  EXPECT_TRUE(std::any_of(t.rows.begin(), t.rows.end(), [](const auto &r) { return r.on_front; }));
}

TEST(tradeoff, has_the_default_however_little_time_there_is_RELEASE)
{
  const Tradeoff t = small(1e-9);
  ASSERT_EQ(t.rows.size(), 2u);    // with both corner rules
  EXPECT_TRUE(t.rows[0].is_default);
  ASSERT_EQ(t.left_out.size(), 1u);
  EXPECT_NE(t.left_out[0].find("no time"), std::string::npos);
}

TEST(tradeoff, leaves_out_what_is_over_the_budget_and_says_so_RELEASE)
{
  const Tradeoff t = small(1e9, 300000);
  EXPECT_FALSE(t.left_out.empty());
  for (const TradeoffRow &r : t.rows) EXPECT_LE(r.bytes, 300000u);
}

}    // namespace
}    // namespace lsdcd::test_tradeoff
