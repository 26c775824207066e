// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The entries of a grid's lists are known before they are made.
#include "base/input_error.h"
#include "engine/engine.h"
#include "grid/build/estimate_lists.h"
#include "grid/triangle_grid.h"
#include "support/meshes.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_build_estimate {
namespace {

// A mesh of long slivers: each has a part in very many bricks.
WeldedMesh slivers(int n)
{
  return weld(cylinder_mesh(n, 1, 50, 100), -1);
}

// For queries and bodies, which have full entries, as estimates count them.
AnyGridSettings settings_of(Real cutoff, AnyGridSettings settings, int nearest = 0)
{
  settings.cutoff = settings.length = cutoff;
  settings.nearest = nearest;
  settings.memory_budget = std::size_t(4) << 30;
  return settings;
}

// The report counts all of them, one by one.
void compare(const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  const TriangleGrid grid = build_any_grid(mesh, settings, false);
  const double entries = double(grid.report.lists.entries);
  const GridPlan plan = plan_grid(mesh, settings);
  const ListEstimate about = estimate_lists(grid.wall, plan, settings.list_kind().has_primitives());
  ASSERT_GT(about.least_entries, 0);
  // Four standard errors on each side; the numbers are the same in every run.
  EXPECT_LE(about.least_entries, entries);
  EXPECT_GE(2 * about.entries - about.least_entries, entries);
  // Worth having: some 400 parts and more are sampled, whose numbers of cells differ by no more
  // than twice their mean; 4 * 2 / sqrt(400).
  EXPECT_NEAR(about.entries, entries, 0.4 * entries);
  // The bytes that a message names as enough.
  EXPECT_GE(estimate_build(grid.wall, plan, settings).enough_bytes,
            double(flat_bytes(grid) - flat_wall_bytes(grid)));
}

BuildEstimate estimate_of_slivers(const AnyGridSettings &purpose, int nearest = 0)
{
  const WeldedMesh mesh = slivers(500);
  const AnyGridSettings settings = settings_of(0.5, purpose, nearest);
  return estimate_build(make_features(mesh, false, true), plan_grid(mesh, settings), settings);
}

}    // namespace

TEST(BuildEstimate, entries_of_slivers_of_a_fine_mesh_and_of_every_triangle_are_as_estimated)
{
  compare(slivers(500), settings_of(0.5, QueryGridSettings()));
  const WeldedMesh fine = weld(cylinder_mesh(200, 99, 50, 100), -1);
  compare(fine, settings_of(1, QueryGridSettings()));
  compare(fine, settings_of(1, BodyGridSettings()));
}

TEST(BuildEstimate, lists_count_but_those_that_are_cut_short_which_may_have_any_size)
{
  EXPECT_EQ(estimate_of_slivers(QueryGridSettings(), 8).least_bytes, 0);
  EXPECT_GT(estimate_of_slivers(QueryGridSettings()).least_bytes, 0);
  EXPECT_GT(estimate_of_slivers(BodyGridSettings()).least_bytes, 0);
}

TEST(BuildEstimate, a_given_cell_that_cannot_fit_is_refused_before_anything_is_built)
{
  std::vector<std::string> told;
  StepGridSettings settings;
  settings.cutoff = settings.length = 0.5;
  settings.memory_budget = std::size_t(20) << 20;
  settings.progress = [&](const std::string &what, double) { told.push_back(what); };
  EXPECT_TRUE(says(error_of([&] { build_grid(slivers(2000), settings); }),
                   {"grid 0.5 takes ", "leave grid out"}));
  EXPECT_TRUE(told.empty()) << told.front();
}

TEST(BuildEstimate, a_chosen_cell_is_not_built_where_it_cannot_fit_LONG)
{
  std::vector<std::string> told;
  StepGridSettings settings;
  settings.cutoff = 0.5;
  settings.memory_budget = std::size_t(60) << 20;
  settings.progress = [&](const std::string &what, double) { told.push_back(what); };
  const StepGrid grid = build_grid(slivers(2000), settings);
  EXPECT_GT(grid.length, 0.7);    // not the first
  ASSERT_FALSE(told.empty());
  EXPECT_FALSE(has(told.front(), "grid 0.5:"));
  // The last cell that was tried is the one that was taken.
  char name[40];
  std::snprintf(name, sizeof name, "grid %.6g:", double(grid.length));
  EXPECT_TRUE(begins(told.back(), name));
}

TEST(BuildEstimate, the_smallest_cutoffs_take_a_coarser_cell_and_say_so)
{
  TriangleSoup one;
  one.corners = {{0, 0, 0}, {1, 0.25, 0.25}, {0.125, 1, 0.5}};
  for (const Real cutoff : {1e-6, 4.9e-324}) {
    StepGridSettings settings;
    settings.cutoff = cutoff;
    const StepGrid grid = build_grid(weld(one, -1), settings);
    EXPECT_GT(grid.length, 1e-4);
    // The limit is of entries of 8 bytes or of the table, whichever are more; and a brick's 128
    // bytes have 64 entries and more, or a quarter.
    EXPECT_LT(double(grid.report.bytes), 2.25 * BuildLimit(1).bytes);
    EXPECT_TRUE(has(describe(grid.report), "takes too much time or memory"));
  }
}

std::string why_refused(const QueryGridSettings &settings)
{
  return lsdcd::error_of([&] { build_grid(slivers(500), settings); });
}

TEST(BuildEstimate, a_given_cell_over_the_limit_is_refused_where_no_budget_lifts_it)
{
  QueryGridSettings settings;
  settings.cutoff = settings.length = 0.1;
  EXPECT_TRUE(has(why_refused(settings), "grid 0.1 is too fine"));
  settings.memory_budget = std::size_t(20) << 20;
  EXPECT_TRUE(has(why_refused(settings), "budget is 20 MB"));
}

TEST(BuildEstimate, progress_names_each_part_of_a_build)
{
  std::vector<std::string> told;
  StepGridSettings settings;
  settings.cutoff = 1;
  settings.progress = [&](const std::string &what, double) { told.push_back(what); };
  build_grid(weld(cylinder_mesh(100, 20, 50, 100), -1), settings);
  for (const char *part : {"sorting into bricks", "finding cells", "writing lists"}) {
    bool found = false;
    for (const std::string &text : told) found |= text.find(part) != text.npos;
    EXPECT_TRUE(found) << part;
  }
}
}    // namespace lsdcd::test_build_estimate
