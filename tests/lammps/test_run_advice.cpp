// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What a run says at its end of processes that wait and of its skin, from numbers whose answers are counted by hand.
#include "lammps/run_advice.h"
#include "support/fake_host.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lsdcd::test_run_advice {
namespace {

// What the first of two processes says, which were busy for so many seconds of 10.
std::string waiting(Real first, Real second, bool balanced = false)
{
  std::string said;
  on_processes(2, [&](FakeHost &host) {
    const std::string words = waiting_advice(host, host.rank() == 0 ? first : second, 10, balanced);
    if (host.rank() == 0) said = words;
  });
  return said;
}

std::string skin(std::int64_t steps, std::int64_t made, std::int64_t forced, Real skin,
                 Real smallest = 1)
{
  Host alone;
  return skin_advice(alone, {steps, made, forced, skin, smallest});
}

bool has(const std::string &text, const std::string &words)
{
  return text.find(words) != std::string::npos;
}

TEST(RunAdvice, ProcessesThatWaitAreToldTheWordsOfFixBalance)
{
  const std::string words = waiting(9, 1);    // 9 - (9 + 1) / 2 of 10
  EXPECT_TRUE(has(words, " 40 %")) << words;
  EXPECT_TRUE(has(words, "fix even all balance 1000 1.05 shift xyz")) << words;
}

TEST(RunAdvice, ProcessesThatWaitForAThirdAreSilent)
{
  EXPECT_EQ(waiting(8, 1.5), "");
}

TEST(RunAdvice, ARunWithBalanceIsToldWhatToChange)
{
  EXPECT_TRUE(has(waiting(9, 1, true), "let fix balance act more often"));
}

TEST(RunAdvice, OneProcessWaitsForNone)
{
  Host alone;
  EXPECT_EQ(waiting_advice(alone, 1, 10, false), "");
}

TEST(RunAdvice, ShortListsAreToldASkinForTwentySteps)
{
  const std::string words = skin(2000, 1000, 0, 0.03);    // 2 steps a list; ten times as many
  EXPECT_TRUE(has(words, "only 2 steps")) << words;
  EXPECT_TRUE(has(words, "neighbor 0.3 bin")) << words;
}

TEST(RunAdvice, ASkinIsNoLargerThanAGrain)
{
  EXPECT_TRUE(has(skin(2000, 1000, 0, 0.3), "neighbor 1 bin"));
  EXPECT_EQ(skin(2000, 1000, 0, 1), "");
}

TEST(RunAdvice, ListsThatOthersForceDoNotCount)
{
  EXPECT_EQ(skin(2000, 1000, 900, 0.03), "");    // 20 steps a list by the way of grains
}

TEST(RunAdvice, LongListsAreToldASmallerSkin)
{
  const std::string words =
      skin(4000, 9, 0, 0.6);    // 400 steps a list; a twentieth, but not below 0.1
  EXPECT_TRUE(has(words, "lasted 400 steps")) << words;
  EXPECT_TRUE(has(words, "neighbor 0.1 bin")) << words;
}

TEST(RunAdvice, ASmallSkinIsLeftAlone)
{
  EXPECT_EQ(skin(4000, 9, 0, 0.1), "");
}

TEST(RunAdvice, ListsThatLastWellAreSilent)
{
  EXPECT_EQ(skin(4000, 200, 0, 0.6), "");
}

TEST(RunAdvice, TheSmallestGrainOfAnyProcessCounts)
{
  std::string said;
  on_processes(2, [&](FakeHost &host) {
    const std::string words =
        skin_advice(host, {4000, 9, 0, 0.6, host.rank() == 0 ? INFINITY : 2.0});
    if (host.rank() == 0) said = words;
  });
  EXPECT_TRUE(has(said, "neighbor 0.2 bin")) << said;
}

}    // namespace
}    // namespace lsdcd::test_run_advice
