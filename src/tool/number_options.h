// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Options of numbers that more than one command has, and their limits.
#pragma once

#include "base/input_words.h"

#include <limits>
#include <string>
#include <vector>

namespace lsdcd {

// What an option of a number holds until it is given.
inline constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

// Checks of words: CLI11's own would print the largest double in their messages.
inline std::string above_zero(const std::string &word)
{
  double value;
  return is_number(word, &value) && value > 0 ? "" : word + " is not a number above 0";
}
inline std::string not_below_zero(const std::string &word)
{
  double value;
  return is_number(word, &value) && value >= 0 ? "" : word + " is not a number of 0 or more";
}
inline std::string not_zero(const std::string &word)
{
  double value;
  return is_number(word, &value) && value != 0 ? "" : word + " is not a number other than 0";
}

// `weld` stays below 0 without the option.
inline void add_weld_option(Command &command, double &weld)
{
  command
      .option("--weld", weld, "weld corners closer than this (default: cracks of 1e-6 of a part)")
      .check(not_below_zero);
}

}    // namespace lsdcd
