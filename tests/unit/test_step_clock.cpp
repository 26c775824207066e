// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Time as the host's steps count it.
#include "motion/step_clock.h"

#include <gtest/gtest.h>

namespace lsdcd::test_step_clock {
namespace {

// 0 at step 10.
StepClock clock()
{
  return {0, 10, 10, 0.5};
}

Real time_after(const std::vector<Step> &steps)
{
  StepClock c = clock();
  for (const Step &s : steps) c.advance(s);
  return static_cast<Real>(c.now());
}

TEST(StepClock, counts_steps_by_their_dt_and_snapshots_by_their_number)
{
  const struct {
    const char *what;
    std::vector<Step> steps;
    Real time;
  } rows[] = {{"steps", {{11, 0.5}, {12, 0.5}}, 1},
              {"a set-up", {{11, 0.5}, {11, 0.5, Step::setup}, {12, 0.5}}, 1},
              {"another dt", {{11, 0.5}, {12, 0.25}, {13, 0.25}}, 1},
              {"another number", {{11, 0.5}, {0, 0.5, Step::setup}, {1, 0.5}}, 1},
              {"a snapshot", {{14, 0.5, Step::snapshot}}, 2},
              {"one before", {{14, 0.5, Step::snapshot}, {8, 0.5, Step::snapshot}}, -1}};
  for (const auto &row : rows) EXPECT_EQ(time_after(row.steps), row.time) << row.what;
}

// Each addition of 0.1 rounds, a product once.
TEST(StepClock, does_not_add_up_rounding)
{
  StepClock c = {0, 0, 0, 0.1};
  for (int i = 1; i <= 1000000; i++) c.advance({i, 0.1});
  EXPECT_EQ(static_cast<Real>(c.now()), 1e5);
}

}    // namespace
}    // namespace lsdcd::test_step_clock
