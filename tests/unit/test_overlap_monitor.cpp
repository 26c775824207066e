// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Warnings of spheres that are deep in the wall, on two processes.
#include "support/fake_host.h"
#include "support/says.h"
#include "wall/checks/overlap_monitor.h"

#include <gtest/gtest.h>

namespace lsdcd::test_overlap_monitor {
namespace {

StepDiagnostics deepest(Real overlap, int sphere, std::int64_t step = 7, int mesh = 0,
                        std::uint32_t meshes = 1)
{
  StepDiagnostics seen;
  seen.deepest_step = step;
  seen.deepest_mesh = mesh;
  seen.deepest_meshes = meshes;
  seen.deepest = overlap;
  seen.deepest_sphere = sphere;
  return seen;
}

// The spheres of a process.
struct Named {
  std::vector<std::int64_t> tags;
  std::vector<Real> radii;
  HostSpheres spheres;

  SpheresOnCpu get()
  {
    spheres.n = static_cast<int>(tags.size());
    spheres.tag = tags.data();
    spheres.radius = radii.data();
    return SpheresOnCpu(spheres);
  }
};

// Process 0 has spheres 1 and 2, process 1 has 3 and 4; their radii are their tags.
Named spheres_of(const FakeHost &host)
{
  Named all;
  all.tags = host.rank() == 0 ? std::vector<std::int64_t>{1, 2} : std::vector<std::int64_t>{3, 4};
  all.radii.assign(all.tags.begin(), all.tags.end());
  return all;
}

// A wall of three meshes.
const WallSpec &wall()
{
  static const WallSpec spec = [] {
    WallSpec of;
    for (const char *name : {"floor.stl", "vane.stl", "inlet.stl"}) {
      MeshSpec mesh;
      mesh.name = name;
      of.meshes.push_back(mesh);
    }
    return of;
  }();
  return spec;
}

void check_sunk(FakeHost &host, OverlapMonitor &monitor, Named &named, Real timestep_ratio = 1)
{
  Real worst = monitor.worst();
  host.max(&worst, 1);
  monitor.check_sunk(worst, timestep_ratio, named.get());
}

// The warnings of the first process where the spheres 1 to 4 overlap so, in step 7.
std::vector<std::string> warned_of_sunk(const std::vector<Real> &overlaps, Real timestep_ratio = 1)
{
  return shown(&FakeHost::warnings, 2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host, wall());
    for (int i : {0, 1}) monitor.note(deepest(overlaps[2 * host.rank() + i], i), named.get());
    check_sunk(host, monitor, named, timestep_ratio);
    check_sunk(host, monitor, named, timestep_ratio);
  });
}

// Looks at spheres 1 to 4 that the run has, then at one with `tag` in place of 4, on process 1,
// which overlaps so in each of the next steps. Returns the warnings of the first process.
std::vector<std::string> warned_of_new(std::int64_t tag, const std::vector<Real> &overlaps,
                                       bool goes_on = true)
{
  return shown(&FakeHost::warnings, 2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host, wall());
    monitor.check_new({}, named.get(), 0, goes_on);
    if (host.rank() == 1) named.tags[1] = tag;
    std::int64_t step = 100;
    for (Real overlap : overlaps) {
      const StepDiagnostics seen = host.rank() == 1 ? deepest(overlap, 1) : StepDiagnostics();
      if (step == 100)
        monitor.check_new(seen, named.get(), step, true);
      else
        monitor.note(seen, named.get());
      step++;
    }
    check_sunk(host, monitor, named);
  });
}

TEST(OverlapMonitor, tells_once_of_the_sphere_that_sank_deepest_on_all_processes)
{
  const std::string sank =
      "sphere 3 sank into the wall by 25 % of its radius 3 in step 7, at mesh 1 'floor.stl': ";
  const std::vector<Real> overlaps = {0.2, 0.15, 0.25, 0.12};
  EXPECT_EQ(
      warned_of_sunk(overlaps),
      std::vector<std::string>{
          sank +
          "the contact is too soft for this load or speed: use a stiffer contact (a larger kn), "
          "which needs a shorter timestep, or lower the speeds; this warning comes again past 50 "
          "%"});
  EXPECT_EQ(warned_of_sunk(overlaps, 12.5),
            std::vector<std::string>{
                sank +
                "the timestep is 12.5 times the longest that resolves a contact: use a shorter one "
                "first. A stiffer "
                "contact would need an even shorter one; this warning comes again past 50 %"});
  const std::vector<std::string> past = warned_of_sunk({1.01, 0, 0, 0});
  ASSERT_EQ(past.size(), 1);
  EXPECT_TRUE(has(past[0], "its centre is past the wall"));
}

// An old grain that overlaps its sharpest part, in the look in which a new one is the deepest.
TEST(OverlapMonitor, tells_of_a_sharp_grain_beside_a_new_one)
{
  FakeHost host;
  WallSpec spec = wall();
  spec.shapes = true;
  OverlapMonitor monitor(host, spec);
  Named named = spheres_of(host);
  monitor.check_new({}, named.get(), 0, true);
  named.tags[1] = 9;
  StepDiagnostics seen = deepest(0.2, 1);
  seen.sharpest = 1.25;
  seen.sharpest_curvature = 0.1;
  seen.sharpest_grain = 0;
  monitor.check_new(seen, named.get(), 100, true);
  host.warnings.clear();
  monitor.check_sharp();
  ASSERT_EQ(host.warnings.size(), 1);
  EXPECT_TRUE(has(host.warnings[0],
                  "sphere 1 overlaps a fold, an edge or a corner of the wall by 1.25 times"));
}

TEST(OverlapMonitor, is_silent_up_to_a_tenth_of_the_radius)
{
  EXPECT_TRUE(warned_of_sunk({0.1, 0.05, 0.1, 0}).empty());
}

// The warnings of the first process where one of the spheres 1 to 4 overlaps so in each step, looked at after each.
std::vector<std::string> warned_step_by_step(const std::vector<StepDiagnostics> &steps)
{
  return shown(&FakeHost::warnings, 2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host, wall());
    for (StepDiagnostics seen : steps) {
      seen.deepest_sphere -= 2 * host.rank();
      if (seen.deepest_sphere == 0 || seen.deepest_sphere == 1) monitor.note(seen, named.get());
      check_sunk(host, monitor, named);
    }
  });
}

TEST(OverlapMonitor, warns_again_past_a_quarter_and_a_half_and_where_a_centre_comes_to_the_wall)
{
  const std::vector<std::string> told = warned_step_by_step(
      {deepest(0.11, 0), deepest(0.2, 3), deepest(0.26, 3), deepest(0.27, 1), deepest(0.49, 2),
       deepest(0.6, 2), deepest(0.94, 2), deepest(0.96, 1, 88, 1, 6), deepest(0.97, 1),
       deepest(1.2, 2, 99, 2, 4)});
  ASSERT_EQ(told.size(), 5U);
  EXPECT_TRUE(has(told[0], "sphere 1 sank into the wall by 11 %"));
  EXPECT_TRUE(has(told[0], "comes again past 25 %"));
  EXPECT_TRUE(has(told[1], "sphere 4 sank into the wall by 26 %"));
  EXPECT_TRUE(has(told[1], "comes again past 50 %"));
  EXPECT_TRUE(has(told[2], "sphere 3 sank into the wall by 60 %"));
  EXPECT_TRUE(has(told[2], "comes again where a centre comes to the wall"));
  EXPECT_TRUE(
      has(told[3],
          "sphere 2 sank into the wall by 96 % of its radius 2 in step 88, pressed by mesh 2 "
          "'vane.stl' and mesh 3 'inlet.stl': its centre came to the wall, so it may come out"));
  EXPECT_TRUE(has(
      told[4], "sphere 3 sank into the wall by 120 % of its radius 3 in step 99, pressed by mesh 3 "
               "'inlet.stl': its centre is past the wall"));
}

TEST(OverlapMonitor, names_both_of_two_spheres_whose_centres_come_to_the_wall_at_once)
{
  const std::vector<std::string> warnings = shown(&FakeHost::warnings, 2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host, wall());
    monitor.note(deepest(0.96 + 0.01 * host.rank(), 0), named.get());
    for (int look = 0; look < 3; look++) check_sunk(host, monitor, named);
  });
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(begins(warnings[0], "sphere 3 sank into the wall by 97 %"));
  EXPECT_TRUE(begins(warnings[1], "sphere 1 sank into the wall by 96 %"));
}

TEST(OverlapMonitor, names_no_more_than_ten)
{
  FakeHost host;
  OverlapMonitor monitor(host, wall());
  Named named;
  for (int i = 0; i < 20; i++) {
    named.tags.push_back(i + 1);
    named.radii.push_back(1);
    monitor.note(deepest(0.96, i), named.get());
    monitor.check_sunk(monitor.worst(), 1, named.get());
  }
  EXPECT_EQ(host.warnings.size(), 10U);
}

// The lines of the first process after two runs, in which the spheres 1 to 4 overlap so.
std::vector<std::string> told_after_runs(const std::vector<std::vector<StepDiagnostics>> &runs,
                                         bool brief = false)
{
  return shown(&FakeHost::lines, 2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host, wall());
    for (const std::vector<StepDiagnostics> &run : runs) {
      for (StepDiagnostics seen : run) {
        seen.deepest_sphere -= 2 * host.rank();
        if (seen.deepest_sphere == 0 || seen.deepest_sphere == 1) monitor.note(seen, named.get());
      }
      monitor.end_run(brief);
    }
  });
}

TEST(OverlapMonitor, tells_the_deepest_overlap_of_each_run)
{
  const std::vector<std::vector<StepDiagnostics>> runs = {
      {deepest(0.01, 0, 5), deepest(0.03, 3, 6, 2, 4), deepest(0.02, 1, 7)},
      {},
      {deepest(0.002, 1, 12, 1, 2)}};
  const std::vector<std::string> told = told_after_runs(runs);
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0], "the deepest overlap of this run is 3 % of the radius of sphere 4, at mesh 3 "
                     "'inlet.stl' in step 6");
  EXPECT_EQ(told[1], "the deepest overlap of this run is 0.2 % of the radius of sphere 2, at mesh "
                     "2 'vane.stl' in step 12");
  EXPECT_TRUE(told_after_runs(runs, true).empty());
}

TEST(OverlapMonitor, tells_of_a_new_sphere_that_is_put_into_the_wall_and_again_only_where_it_sinks)
{
  const std::string appeared =
      "sphere 5 appeared inside the wall, which it overlaps by 50 % of its "
      "radius 4 in step 100: it will be thrown out";
  const struct {
    const char *what;
    std::int64_t tag;
    std::vector<Real> overlaps;
    std::vector<std::string> told;
  } rows[] = {
      {"it goes out", 5, {0.5, 0.54, 0.4, 0.2}, {appeared}},
      {"it sinks deeper", 5, {0.5, 0.56}, {appeared, "sphere 5 sank into the wall by 56 %"}},
      {"it was out", 5, {0.5, 0.1, 0.2}, {appeared, "sphere 5 sank into the wall by 20 %"}},
      {"it was there before", 4, {0.5}, {"sphere 4 sank"}}};
  for (const auto &row : rows) {
    const std::vector<std::string> told = warned_of_new(row.tag, row.overlaps);
    ASSERT_EQ(told.size(), row.told.size()) << row.what;
    for (std::size_t i = 0; i < told.size(); i++) EXPECT_TRUE(begins(told[i], row.told[i]));
  }
}

// The warnings of the first process where spheres come one after the other and overlap so.
std::vector<std::string> warned_of_coming(const std::vector<Real> &overlaps, bool goes_on)
{
  return shown(&FakeHost::warnings, 2, [&](FakeHost &host) {
    OverlapMonitor monitor(host, wall());
    Named named;
    for (Real overlap : overlaps) {
      const int n = static_cast<int>(named.tags.size());
      named.tags.push_back(2 * n + host.rank() + 1);
      named.radii.push_back(1);
      monitor.check_new(host.rank() == 1 ? deepest(overlap, n) : StepDiagnostics(), named.get(), n,
                        goes_on);
    }
  });
}

TEST(OverlapMonitor, tells_again_of_new_spheres_that_are_a_tenth_deeper)
{
  const std::vector<std::string> told = warned_of_coming({0.5, 0.54, 0.56}, false);
  ASSERT_EQ(told.size(), 2);
  EXPECT_TRUE(begins(told[1], "sphere 6 appeared inside the wall, which it overlaps by 56 %"));
}

TEST(OverlapMonitor, takes_the_first_spheres_of_a_run_that_goes_on_for_old_ones)
{
  EXPECT_TRUE(warned_of_coming({0.5}, true).empty());
  EXPECT_EQ(warned_of_coming({0.5}, false).size(), 1);
}

}    // namespace
}    // namespace lsdcd::test_overlap_monitor
