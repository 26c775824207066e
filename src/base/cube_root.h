// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cube root, from basic arithmetic alone: the same bits on every backend.
#pragma once

#include "base/real.h"

#include <cstdint>
#include <cstring>

namespace lsdcd {

// Returns the cube root of x >= 0, to a rounding or two; 0 below the smallest normal number. A third of the exponent's
// bits is the root to 5 %; each of Halley's steps has the cube of the error of the one before: 8e-5, 4e-13, below
// rounding.
LSDCD_FN Real cube_root(Real x)
{
  if (!(x >= 2.2250738585072014e-308)) return 0;
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = bits / 3 + 0x2a9f7893782da1ceu;
  Real y;
  std::memcpy(&y, &bits, sizeof y);
  for (int k = 0; k < 3; k++) {
    const Real cube = y * y * y;
    y = y * ((cube + 2 * x) / (2 * cube + x));
  }
  return y;
}

}    // namespace lsdcd
