// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arc tangent, from basic arithmetic and roots alone: the same bits on every backend.
#pragma once

#include "base/real.h"

#include <cmath>

namespace lsdcd {

// Returns the angle in [0, pi/2) whose tangent is x >= 0, to a few roundings. The angle is halved three times, to at most pi/16, where the
// terms of the series that are left out are below rounding.
LSDCD_FN Real arc_tangent(Real x)
{
  for (int halved = 0; halved < 3; halved++) x = x / (1 + sqrt(1 + x * x));
  constexpr int kTerms = 12;
  const Real sq = x * x;
  Real sum = 0;
  for (int k = kTerms - 1; k >= 0; k--) sum = (k % 2 ? Real(-1) : Real(1)) / (2 * k + 1) + sq * sum;
  return 8 * x * sum;
}

}    // namespace lsdcd
