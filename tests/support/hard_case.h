// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A hard case: the right answer, ours and a derived tolerance. It is checked and written down.
#pragma once

#include "support/device.h"

#include "base/real.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>

namespace lsdcd {

// A row of doc/data/hard_cases_DEVICE.tsv. `theme` is its section in
// doc/hard_cases.md; `id` tells cases apart (text, as "11" or "6a"). `what` names the case and what is
// measured.
struct HardCase {
  std::string theme, id, what;
};

namespace hard_case_detail {

// Adds a line to the file that LSDCD_HARD_CASES names, if it does.
inline void write_row(const HardCase &c, const char *relation, Real answer, Real ours,
                      Real tolerance, const std::string &derivation, bool holds)
{
  const char *path = std::getenv("LSDCD_HARD_CASES");
  if (!path || !*path) return;
  std::FILE *file = std::fopen(path, "a");
  if (!file) {
    ADD_FAILURE() << "cannot write " << path << ", which LSDCD_HARD_CASES names";
    return;
  }
  std::fprintf(file, "%s\t%s\t%s\t%s\t%s\t%s\t%.17g\t%.17g\t%.3g\t%s\t%s\n", c.theme.c_str(),
               c.id.c_str(), c.what.c_str(), test_on_cuda() ? "cuda" : "cpu",
               sizeof(Real) == sizeof(double) ? "double" : "single", relation, answer, ours,
               tolerance, derivation.c_str(), holds ? "holds" : "FAILS");
  std::fclose(file);
}

}    // namespace hard_case_detail

// |ours - answer| <= tolerance, for a case with a closed form or a reference of its own.
inline void expect_answer(const HardCase &c, Real answer, Real ours, Real tolerance,
                          const std::string &derivation)
{
  const bool holds = std::fabs(ours - answer) <= tolerance;
  hard_case_detail::write_row(c, "=", answer, ours, tolerance, derivation, holds);
  EXPECT_NEAR(ours, answer, tolerance) << c.id << " " << c.what << ": " << derivation;
}

// ours <= bound, for what should vanish or stay small.
inline void expect_at_most(const HardCase &c, Real ours, Real bound, const std::string &derivation)
{
  const bool holds = ours <= bound;
  hard_case_detail::write_row(c, "<=", bound, ours, 0, derivation, holds);
  EXPECT_LE(ours, bound) << c.id << " " << c.what << ": " << derivation;
}

// ours >= bound, for what has to happen: that a bound is sharp, that a fault is seen.
inline void expect_at_least(const HardCase &c, Real ours, Real bound, const std::string &derivation)
{
  const bool holds = ours >= bound;
  hard_case_detail::write_row(c, ">=", bound, ours, 0, derivation, holds);
  EXPECT_GE(ours, bound) << c.id << " " << c.what << ": " << derivation;
}

}    // namespace lsdcd
