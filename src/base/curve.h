// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A Z-curve through a box: what is near along it is near in space.
#pragma once

#include "base/vec3.h"

#include <cstdint>

namespace lsdcd {

// Every third bit is one of `i`'s, less than 2^10.
LSDCD_FN std::uint32_t spread_bits(std::uint32_t i)
{
  i = (i | i << 16) & 0x030000ffu;
  i = (i | i << 8) & 0x0300f00fu;
  i = (i | i << 4) & 0x030c30c3u;
  return (i | i << 2) & 0x09249249u;
}

// The number, along the curve, of a point whose coordinates are shares of the box's sides, 0 to 1; points outside
// count as on the faces. The
// curve has 2^`bits` steps a side, `bits` up to 10.
LSDCD_FN std::uint32_t number_on_curve(const Vec3 &share, int bits)
{
  std::uint32_t place = 0;
  const Real n = static_cast<Real>(1 << bits);
  for (int a = 0; a < 3; a++)
    place |= spread_bits(static_cast<std::uint32_t>(smaller(larger(share[a] * n, 0), n - 1))) << a;
  return place;
}

}    // namespace lsdcd
