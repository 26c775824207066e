// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Warnings of spheres that are deep in the wall, on two processes.
#include "support/fake_host.h"
#include "wall/overlap_monitor.h"

#include <gtest/gtest.h>

namespace lsdcd::test_overlap_monitor {
namespace {

StepDiagnostics deepest(Real overlap, int sphere)
{
  StepDiagnostics seen;
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

void check_sunk(FakeHost &host, OverlapMonitor &monitor, Named &named, Real timestep_ratio = 1)
{
  Real worst = monitor.worst();
  host.max(&worst, 1);
  monitor.check_sunk(worst, timestep_ratio, named.get());
}

// The warnings of the first process where the spheres 1 to 4 overlap so, in step 7.
std::vector<std::string> warned_of_sunk(const std::vector<Real> &overlaps, Real timestep_ratio = 1)
{
  std::vector<std::string> warnings;
  on_processes(2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host);
    for (int i : {0, 1}) monitor.note(deepest(overlaps[2 * host.rank() + i], i), named.get(), 7);
    check_sunk(host, monitor, named, timestep_ratio);
    check_sunk(host, monitor, named, timestep_ratio);
    if (host.rank() == 0) warnings = host.warnings;
  });
  return warnings;
}

// Looks at spheres 1 to 4 that the run has, then at one with `tag` in place of 4, on process 1,
// which overlaps so in each of the next steps. Returns the warnings of the first process.
std::vector<std::string> warned_of_new(std::int64_t tag, const std::vector<Real> &overlaps,
                                       bool goes_on = true)
{
  std::vector<std::string> warnings;
  on_processes(2, [&](FakeHost &host) {
    Named named = spheres_of(host);
    OverlapMonitor monitor(host);
    monitor.check_new({}, named.get(), 0, goes_on);
    if (host.rank() == 1) named.tags[1] = tag;
    std::int64_t step = 100;
    for (Real overlap : overlaps) {
      const StepDiagnostics seen = host.rank() == 1 ? deepest(overlap, 1) : StepDiagnostics();
      if (step == 100)
        monitor.check_new(seen, named.get(), step, true);
      else
        monitor.note(seen, named.get(), step);
      step++;
    }
    check_sunk(host, monitor, named);
    if (host.rank() == 0) warnings = host.warnings;
  });
  return warnings;
}

TEST(OverlapMonitor, tells_once_of_the_sphere_that_sank_deepest_on_all_processes)
{
  const std::vector<std::string> told = warned_of_sunk({0.2, 0.15, 0.25, 0.12});
  ASSERT_EQ(told.size(), 1);
  EXPECT_EQ(told[0],
            "sphere 3 sank into the wall by 25 % of its radius 3 by step 7: the contact "
            "is too soft for this load or speed: use a stiffer contact (a larger kn), "
            "which needs a shorter timestep, or lower the speeds; this warning is shown once");
}

TEST(OverlapMonitor, blames_a_timestep_that_is_too_long_before_the_stiffness)
{
  const std::vector<std::string> told = warned_of_sunk({0.2, 0.15, 0.25, 0.12}, 12.5);
  ASSERT_EQ(told.size(), 1);
  EXPECT_EQ(
      told[0],
      "sphere 3 sank into the wall by 25 % of its radius 3 by step 7: the timestep is 12.5 times "
      "the longest that resolves a contact: use a shorter one first. A stiffer contact would need "
      "an even shorter one; this warning is shown once");
}

TEST(OverlapMonitor, is_silent_up_to_a_tenth_of_the_radius)
{
  EXPECT_TRUE(warned_of_sunk({0.1, 0.05, 0.1, 0}).empty());
}

TEST(OverlapMonitor, names_the_side_where_a_centre_is_past_the_wall)
{
  const std::vector<std::string> told = warned_of_sunk({1.01, 0, 0, 0});
  ASSERT_EQ(told.size(), 1);
  EXPECT_NE(told[0].find("its centre is past the wall"), std::string::npos);
}

TEST(OverlapMonitor, tells_of_a_new_sphere_that_was_put_into_the_wall)
{
  const std::vector<std::string> told = warned_of_new(5, {0.5});
  ASSERT_EQ(told.size(), 1);
  EXPECT_EQ(
      told[0].find("sphere 5 appeared inside the wall, which it overlaps by 50 % of its radius "
                   "4 in step 100: it will be thrown out"),
      0);
}

TEST(OverlapMonitor, takes_a_sphere_that_was_there_before_for_one_that_sank)
{
  const std::vector<std::string> told = warned_of_new(4, {0.5});
  ASSERT_EQ(told.size(), 1);
  EXPECT_EQ(told[0].find("sphere 4 sank"), 0);
}

TEST(OverlapMonitor, does_not_tell_again_of_a_new_sphere_that_is_on_its_way_out)
{
  EXPECT_EQ(warned_of_new(5, {0.5, 0.54, 0.4, 0.2}).size(), 1);
}

TEST(OverlapMonitor, tells_of_a_new_sphere_that_sinks_deeper)
{
  const std::vector<std::string> told = warned_of_new(5, {0.5, 0.56});
  ASSERT_EQ(told.size(), 2);
  EXPECT_EQ(told[1].find("sphere 5 sank into the wall by 56 %"), 0);
}

TEST(OverlapMonitor, tells_of_a_new_sphere_that_was_out_and_sank_again)
{
  const std::vector<std::string> told = warned_of_new(5, {0.5, 0.1, 0.2});
  ASSERT_EQ(told.size(), 2);
  EXPECT_EQ(told[1].find("sphere 5 sank into the wall by 20 %"), 0);
}

// The warnings of the first process where spheres come one after the other and overlap so.
std::vector<std::string> warned_of_coming(const std::vector<Real> &overlaps, bool goes_on)
{
  std::vector<std::string> warnings;
  on_processes(2, [&](FakeHost &host) {
    OverlapMonitor monitor(host);
    Named named;
    for (Real overlap : overlaps) {
      const int n = static_cast<int>(named.tags.size());
      named.tags.push_back(2 * n + host.rank() + 1);
      named.radii.push_back(1);
      monitor.check_new(host.rank() == 1 ? deepest(overlap, n) : StepDiagnostics(), named.get(), n,
                        goes_on);
    }
    if (host.rank() == 0) warnings = host.warnings;
  });
  return warnings;
}

TEST(OverlapMonitor, tells_again_of_new_spheres_that_are_a_tenth_deeper)
{
  const std::vector<std::string> told = warned_of_coming({0.5, 0.54, 0.56}, false);
  ASSERT_EQ(told.size(), 2);
  EXPECT_EQ(told[1].find("sphere 6 appeared inside the wall, which it overlaps by 56 %"), 0);
}

TEST(OverlapMonitor, takes_the_first_spheres_of_a_run_that_goes_on_for_old_ones)
{
  EXPECT_TRUE(warned_of_coming({0.5}, true).empty());
  EXPECT_EQ(warned_of_coming({0.5}, false).size(), 1);
}

}    // namespace
}    // namespace lsdcd::test_overlap_monitor
