// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/kept_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace lsdcd::test_kept_rows {
namespace {

// What grain i has in a message.
std::vector<Real> packed(const KeptRows &rows, int i)
{
  std::vector<Real> numbers(static_cast<std::size_t>(rows.packed_size(i)));
  EXPECT_EQ(rows.pack(i, numbers.data()), rows.packed_size(i));
  return numbers;
}

TEST(kept_rows, are_added_as_zeros_behind_those_that_are_there)
{
  KeptRows rows(2);
  rows.grow(3);
  const std::vector<Real> two = {2, 1, -2, 3.5, 4}, one = {1, 7, 8};
  EXPECT_EQ(rows.unpack(1, two.data()), 5);
  EXPECT_EQ(rows.unpack(2, one.data()), 3);
  Real *const added = rows.add(1, 2);
  EXPECT_EQ(packed(rows, 1), (std::vector<Real>{4, 1, -2, 3.5, 4, 0, 0, 0, 0}));
  std::fill_n(added, 4, 9);
  EXPECT_EQ(packed(rows, 1), (std::vector<Real>{4, 1, -2, 3.5, 4, 9, 9, 9, 9}));
  EXPECT_EQ(rows.unpack_more(1, one.data()), 3);
  EXPECT_EQ(packed(rows, 1), (std::vector<Real>{5, 1, -2, 3.5, 4, 9, 9, 9, 9, 7, 8}));
  EXPECT_EQ(packed(rows, 0), (std::vector<Real>{0}));
  EXPECT_EQ(packed(rows, 2), one);
  EXPECT_EQ(rows.largest_packed_size(), 1 + 5 * 2);
}

TEST(kept_rows, are_gone_when_others_begin)
{
  KeptRows rows(2);
  rows.grow(2);
  const std::vector<Real> of_two = {1, 7, 8}, of_three = {1, 4, 5, 6};
  rows.unpack(0, of_two.data());
  rows.begin(3);
  EXPECT_EQ(rows.n_grains(), 2);
  EXPECT_EQ(rows.count(0), 0);
  rows.unpack(1, of_three.data());
  EXPECT_EQ(packed(rows, 0), (std::vector<Real>{0}));
  EXPECT_EQ(packed(rows, 1), of_three);
}

TEST(kept_rows, get_another_size_one_by_one)
{
  KeptRows rows(2);
  rows.grow(2);
  const std::vector<Real> two = {2, 1, 2, 3, 4};
  rows.unpack(1, two.data());
  rows.copy(1, 0);
  rows.resize_rows(3, [](const Real *from, Real *to) {
    to[0] = from[1];
    to[2] = from[0];
  });
  for (int i = 0; i < 2; i++) EXPECT_EQ(packed(rows, i), (std::vector<Real>{2, 2, 0, 1, 4, 0, 3}));
}

}    // namespace
}    // namespace lsdcd::test_kept_rows
