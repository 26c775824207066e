// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lines of the log about the search for contacts, from two processes.
#include "support/fake_host.h"
#include "wall/reports/search_report.h"

#include <gtest/gtest.h>

namespace lsdcd::test_search_report {
namespace {

StepDiagnostics lists(std::int64_t made, std::int64_t features, std::int64_t by_cells)
{
  StepDiagnostics seen;
  seen.lists = made;
  seen.listed = features;
  seen.by_cells = by_cells;
  return seen;
}

// The log of the first process at the end of each run of `steps` steps with a setup, in which the
// processes note 1 and 2 times `seen`.
std::vector<std::string> logged_runs(const std::vector<int> &steps, const StepDiagnostics &seen)
{
  return shown(&FakeHost::lines, 2, [&](FakeHost &host) {
    SearchReport report(host);
    for (int n : steps) {
      report.count_step(true);
      for (int i = 0; i < n; i++) report.count_step(false);
      report.count_update();
      for (int i = 0; i <= host.rank(); i++) report.add(seen);
      report.end_run(false, " (advice)");
    }
  });
}

TEST(SearchReport, adds_up_what_all_processes_have_listed_and_searched)
{
  const std::string searched = "spheres near the wall searched for 1 time (advice), ";
  EXPECT_EQ(logged_runs({5}, lists(2, 3, 0)),
            std::vector<std::string>{"5 steps and the setup: " + searched +
                                     "wall neighbor lists made 6 times, 1.50 mesh features each"});
  EXPECT_EQ(logged_runs({1}, lists(0, 0, 4)),
            std::vector<std::string>{"1 step and the setup: " + searched +
                                     "a grid cell searched instead 12 times"});
}

TEST(SearchReport, counts_each_run_anew)
{
  const std::vector<std::string> lines = logged_runs({5, 5}, lists(2, 3, 4));
  ASSERT_EQ(lines.size(), 2);
  EXPECT_EQ(lines[0], lines[1]);
}

TEST(SearchReport, logs_nothing_without_a_step)
{
  on_processes(2, [](FakeHost &host) {
    SearchReport report(host);
    report.end_run(false, "");
    EXPECT_TRUE(host.lines.empty());
  });
}

// The uncertified answers of nearest lists in one run, on process 1.
struct Uncertified {
  std::int64_t answers;
  Real overlap;
};

std::vector<std::string> logged_uncertified(const std::vector<Uncertified> &runs,
                                            bool brief = false)
{
  return shown(&FakeHost::lines, 2, [&](FakeHost &host) {
    SearchReport report(host);
    for (const Uncertified &run : runs) {
      StepDiagnostics seen;
      seen.uncertified = run.answers;
      seen.uncertain = run.overlap;
      report.add(host.rank() == 1 ? seen : StepDiagnostics());
      report.log_uncertified(4, brief);
    }
  });
}

TEST(SearchReport, tells_after_the_first_run_that_all_answers_were_certified)
{
  EXPECT_EQ(logged_uncertified({{0, 0}, {0, 0}}),
            std::vector<std::string>{"nearest 4: 0 answers were not certified exact"});
}

TEST(SearchReport, tells_the_brief_of_uncertified_answers_only)
{
  EXPECT_TRUE(logged_uncertified({{0, 0}}, true).empty());
  EXPECT_EQ(logged_uncertified({{1, 0.1}}, true).size(), 1);
}

TEST(SearchReport, tells_how_deep_contacts_are_that_may_have_been_missed)
{
  const std::vector<std::string> lines = logged_uncertified({{3, 0.02}});
  ASSERT_EQ(lines.size(), 1);
  EXPECT_EQ(lines[0].find("nearest 4: 3 answers were not certified exact; contacts overlapping by "
                          "up to 2 % of a radius may have been missed"),
            0);
}

TEST(SearchReport, tells_again_when_uncertified_answers_are_ten_times_as_many)
{
  EXPECT_EQ(logged_uncertified({{3, 0.02}, {26, 0.02}}).size(), 1);    // 29 in all
  EXPECT_EQ(logged_uncertified({{3, 0.02}, {27, 0.02}}).size(), 2);
}

TEST(SearchReport, tells_again_when_missed_contacts_may_be_twice_as_deep)
{
  EXPECT_EQ(logged_uncertified({{3, 0.02}, {1, 0.039}}).size(), 1);
  EXPECT_EQ(logged_uncertified({{3, 0.02}, {1, 0.04}}).size(), 2);
}

}    // namespace
}    // namespace lsdcd::test_search_report
