// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of the study: printed as they come, and written as CSV.
#pragma once

#include "study/accuracy.h"

#include <string>
#include <vector>

namespace lsdcd {

// Columns that a table varies besides the row itself.
struct RowContext {
  std::string table, shape, order, commit;
  Real cube = 0, largest = 1;
  std::uint64_t seed = 1;
};

// The paper's numbers for the same row; below 0: it gives none.
struct PaperColumns {
  Real accuracy = -1, error = -1, query_s = -1, build_s = -1;
};

class AccuracyRows {
 public:
  void begin(const std::string &title);
  void add(const RowContext &context, const StudyRow &row, const PaperColumns &paper = {},
           const std::string &note = "");

  // Every row so far, with a heading.
  std::string csv() const;

 private:
  std::string csv_;
};

std::string lists_name(const StudyLists &lists);

}    // namespace lsdcd
