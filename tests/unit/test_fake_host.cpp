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

TEST(FakeHost, names_the_lowest_rank_of_those_that_have_something)
{
  on_processes(3, [](FakeHost &host) {
    EXPECT_EQ(lowest_rank(host, host.rank() > 0), 1);
    EXPECT_EQ(lowest_rank(host, false), 3);
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
