// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of things whose places are ints.
#ifndef LSDCD_BASE_COUNTABLE_H
#define LSDCD_BASE_COUNTABLE_H

#include "base/input_error.h"

#include <cstdint>
#include <limits>
#include <string>

namespace lsdcd {

// Returns n as an int, or throws what there are too many of and the remedy; a sum that has become negative has passed
// the limit as well.
inline int countable(std::int64_t n, const std::string &things, const std::string &remedy)
{
  constexpr int kMost = std::numeric_limits<int>::max();
  if (n >= 0 && n <= kMost) return static_cast<int>(n);
  const std::string many = n < 0 ? "more " : std::to_string(n) + " ";
  throw InputError(many + things + (n < 0 ? " than " : " are more than ") + "an int counts, " +
                   std::to_string(kMost) + ": " + remedy);
}

// The same for what only this process has: others do not know of the error.
inline int countable_here(std::int64_t n, const std::string &things, const std::string &remedy)
{
  try {
    return countable(n, things, remedy);
  } catch (InputError &e) {
    e.is_local = true;
    throw;
  }
}

}    // namespace lsdcd

#endif
