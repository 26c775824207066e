// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Integers in messages of a host on a GPU, which are doubles.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace lsdcd {

// An integer in the place of a double, as such messages have it.
LSDCD_FN double as_double(std::int64_t value)
{
  double bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}
LSDCD_FN std::int64_t as_integer(double bits)
{
  std::int64_t value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

// Where the numbers of the k-th sphere begin in two messages, each with its offsets first: those of the first are n_first, and the
// second begins at `second`.
LSDCD_FN std::int64_t place_in_message(const double *buffer, std::size_t k, int n_first, int second)
{
  if (k < static_cast<std::size_t>(n_first)) return as_integer(buffer[k]);
  return second + as_integer(buffer[second + (k - n_first)]);
}

}    // namespace lsdcd
