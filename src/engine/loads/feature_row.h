// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of numbers that are added up over steps for each feature (a face, an edge or a vertex) of a mesh: on the CPU, in the memory
// of an engine and in saved states. A row is a struct of Reals. The first kSums of them add up; of each of the next kMost, which
// are never below 0, the greatest is kept. See load.h.
#pragma once

#include "base/real.h"
#include "geometry/feature_code.h"

#include <cstring>
#include <type_traits>

namespace lsdcd {

// The numbers of a row, in the order of its members.
template <class Row>
struct RowNumbers {
  static constexpr int kNumbers = Row::kSums + Row::kMost;
  static_assert(sizeof(Row) == kNumbers * sizeof(Real), "kSums and kMost count all members");
  static_assert(std::is_trivially_copyable<Row>::value, "a row is copied as its numbers");

  Real of[kNumbers];

  RowNumbers() = default;
  LSDCD_FN explicit RowNumbers(const Row &row) { memcpy(of, &row, sizeof of); }

  LSDCD_FN Row row() const
  {
    Row row;
    memcpy(&row, of, sizeof of);
    return row;
  }
};

// Adds a part of a row to another one.
template <class Row>
void add_row(const Row &row, Real part, Row &to)
{
  const RowNumbers<Row> more(row);
  RowNumbers<Row> all(to);
  for (int j = 0; j < Row::kSums; j++) all.of[j] += part * more.of[j];
  for (int j = Row::kSums; j < all.kNumbers; j++) all.of[j] = larger(more.of[j], all.of[j]);
  to = all.row();
}

template <class Row>
struct RowOfFeature {
  FeatureCode feature;
  Row row;
};

}    // namespace lsdcd
