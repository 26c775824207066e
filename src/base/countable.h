// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of things whose places are ints.
#pragma once

#include "base/input_error.h"

#include <cstdint>
#include <limits>
#include <string>

namespace lsdcd {

constexpr int kMostCountable = std::numeric_limits<int>::max();

inline bool is_countable(std::int64_t n)
{
  return n >= 0 && n <= kMostCountable;
}

// Returns what there are too many of, and the remedy. A sum that has become negative has passed the limit as well.
inline std::string uncountable(std::int64_t n, const std::string &things, const std::string &remedy)
{
  const std::string many = n < 0 ? "more " : std::to_string(n) + " ";
  return many + things + (n < 0 ? " than " : " are more than ") + "an int counts, " +
         std::to_string(kMostCountable) + ": " + remedy;
}

// Returns n as an int, or throws.
inline int countable(std::int64_t n, const std::string &things, const std::string &remedy)
{
  if (!is_countable(n)) throw InputError(uncountable(n, things, remedy));
  return static_cast<int>(n);
}

// The same for what only this process has: others do not know of the error.
inline int countable_here(std::int64_t n, const std::string &things, const std::string &remedy)
{
  if (!is_countable(n)) fail_here(uncountable(n, things, remedy));
  return static_cast<int>(n);
}

}    // namespace lsdcd
