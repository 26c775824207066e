// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The host of the wall's unit tests finds processes that would wait for each other forever.
#include "base/input_error.h"
#include "support/fake_host.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace lsdcd::test_fake_host {
namespace {

TEST(FakeHost, sums_the_numbers_of_all_processes)
{
  on_processes(2, [](FakeHost &host) {
    Real numbers[2] = {host.rank() + 1.0, 4};
    host.sum(numbers, 2);
    EXPECT_EQ(numbers[0], 3);
    EXPECT_EQ(numbers[1], 8);
  });
}

// Whole numbers of 64 bits, which a sum of doubles would round, of both signs and up to the ends of their range.
TEST(FakeHost, sums_whole_numbers_exactly)
{
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  on_processes(3, [](FakeHost &host) {
    const int p = host.rank();
    std::vector<std::int64_t> numbers = {
        p == 0 ? kMost : -p, p == 1 ? -kMost : p - 1, (std::int64_t(1) << 60) + 1 - p,
        -(std::int64_t(1) << 61) + p, p == 2 ? kMost : -(std::int64_t(1) << 62)};
    sum_exactly(host, numbers);
    const std::vector<std::int64_t> expected = {kMost - 3, -kMost, 3 * (std::int64_t(1) << 60),
                                                -3 * (std::int64_t(1) << 61) + 3, -1};
    EXPECT_EQ(numbers, expected);
  });
}

TEST(FakeHost, finds_the_largest_numbers_of_all_processes)
{
  on_processes(2, [](FakeHost &host) {
    Real numbers[2] = {host.rank() == 0 ? 1.0 : 2.0, host.rank() == 0 ? -3.0 : -4.0};
    host.max(numbers, 2);
    EXPECT_EQ(numbers[0], 2);
    EXPECT_EQ(numbers[1], -3);
  });
}

TEST(FakeHost, names_the_lowest_rank_of_those_that_have_something)
{
  on_processes(3, [](FakeHost &host) {
    EXPECT_EQ(lowest_rank(host, host.rank() > 0), 1);
    EXPECT_EQ(lowest_rank(host, false), 3);
  });
}

TEST(FakeHost, hands_over_what_one_process_has)
{
  on_processes(2, [](FakeHost &host) {
    int number = host.rank();
    host.broadcast(&number, sizeof number, 1);
    EXPECT_EQ(number, 1);
  });
}

TEST(FakeHost, gathers_numbers_on_the_first_process)
{
  on_processes(2, [](FakeHost &host) {
    const std::vector<Real> mine(host.rank() + 1, host.rank());
    const std::vector<Real> all = {0, 1, 1};
    EXPECT_EQ(host.gather(mine), host.rank() == 0 ? all : std::vector<Real>());
  });
}

TEST(FakeHost, throws_an_error_of_one_process_on_all)
{
  on_processes(2, [](FakeHost &host) {
    const auto fail = [] { throw std::runtime_error("no room"); };
    try {
      run_collectively(host, host.rank() == 1, fail);
      FAIL() << "nothing is thrown";
    } catch (const InputError &e) {
      EXPECT_STREQ(e.what(), "no room");
    }
  });
}

TEST(FakeHost, throws_nothing_where_all_is_well)
{
  on_processes(2, [](FakeHost &host) { run_collectively(host, true, [] {}); });
}

TEST(FakeHost, refuses_a_call_that_one_process_does_not_make)
{
  const auto one_calls = [](FakeHost &host) {
    Real number = 0;
    if (host.rank() == 1) host.max(&number, 1);
  };
  EXPECT_THROW(on_processes(2, one_calls), std::logic_error);
}

TEST(FakeHost, refuses_calls_in_another_order)
{
  const auto other_order = [](FakeHost &host) {
    Real number = 0;
    if (host.rank() == 0) host.max(&number, 1);
    host.sum(&number, 1);
    if (host.rank() == 1) host.max(&number, 1);
  };
  EXPECT_THROW(on_processes(2, other_order), std::logic_error);
}

}    // namespace
}    // namespace lsdcd::test_fake_host
