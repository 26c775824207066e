// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The table of a run's times, from two processes whose clocks the tests turn.
#include "support/fake_host.h"
#include "support/says.h"
#include "wall/reports/time_report.h"

#include <gtest/gtest.h>

namespace lsdcd::test_time_report {
namespace {

using Section = TimeReport::Section;

struct Spent {
  Section section;
  Real seconds[2];    // on each process
};

void spend(TimeReport &report, Real &now, Real seconds, Section section)
{
  now += 100;    // outside of the wall
  report.begin();
  now += seconds;
  report.end(section);
}

// The log of the first process at the end of `runs` runs, in each of which `all` is spent.
std::vector<std::string> logged(const std::vector<Spent> &all, Real loop, int runs = 1)
{
  return shown(&FakeHost::lines, 2, [&](FakeHost &host) {
    Real now = 0;
    TimeReport report(host, [&] { return now; });
    for (int run = 0; run < runs; run++) {
      for (const Spent &s : all) spend(report, now, s.seconds[host.rank()], s.section);
      report.end_run(false, loop);
    }
  });
}

// The one table of a run.
std::string table(const std::vector<Spent> &all, Real loop)
{
  const std::vector<std::string> lines = logged(all, loop);
  EXPECT_EQ(lines.size(), 1);
  return lines.empty() ? "" : lines[0];
}

const std::vector<Spent> two_sections = {
    {TimeReport::choice, {1, 3}}, {TimeReport::forces, {1, 4}}, {TimeReport::forces, {3, 8}}};

TEST(TimeReport, has_least_average_and_most_of_the_processes)
{
  EXPECT_EQ(table(two_sections, 20),
            "timing breakdown of the wall, 50.00 % of the loop time:\n"
            "  Section |  min time  |  avg time  |  max time  |%varavg| %total| %loop\n"
            "  ----------------------------------------------------------------------\n"
            "  Search  | 1          | 2          | 3          |  50.0 | 20.00 | 10.00\n"
            "  Forces  | 4          | 8          | 12         |  50.0 | 80.00 | 40.00");
}

TEST(TimeReport, has_no_share_of_a_loop_time_that_is_not_known)
{
  EXPECT_EQ(table(two_sections, 0),
            "timing breakdown of the wall:\n"
            "  Section |  min time  |  avg time  |  max time  |%varavg| %total\n"
            "  ---------------------------------------------------------------\n"
            "  Search  | 1          | 2          | 3          |  50.0 | 20.00\n"
            "  Forces  | 4          | 8          | 12         |  50.0 | 80.00");
}

TEST(TimeReport, keeps_a_section_of_one_process)
{
  const std::string text = table({{TimeReport::files, {0, 2}}}, 0);
  EXPECT_TRUE(has(text, "\n  Files   | 0          | 1          | 2          | 100.0 |100.00"));
}

TEST(TimeReport, counts_from_the_end_of_one_section_to_that_of_the_next)
{
  on_processes(1, [](FakeHost &host) {
    Real now = 0;
    TimeReport report(host, [&] { return now; });
    report.begin();
    now = 1;
    report.end(TimeReport::choice);
    now = 4;
    report.end(TimeReport::forces);
    report.end_run(false, 0);
    ASSERT_EQ(host.lines.size(), 1);
    EXPECT_TRUE(has(host.lines[0], "Search  | 1          | 1 "));
    EXPECT_TRUE(has(host.lines[0], "Forces  | 3          | 3 "));
  });
}

TEST(TimeReport, counts_each_run_anew)
{
  const std::vector<std::string> lines = logged(two_sections, 20, 2);
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0], lines[1]);
}

TEST(TimeReport, forgets_what_was_before_a_run)
{
  on_processes(2, [](FakeHost &host) {
    Real now = 0;
    TimeReport report(host, [&] { return now; });
    spend(report, now, 1, TimeReport::grids);
    report.begin_run();
    report.end_run(false, 20);
    EXPECT_TRUE(host.lines.empty());
  });
}

}    // namespace
}    // namespace lsdcd::test_time_report
