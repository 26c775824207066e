// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Whether two grains have no point in common.
#pragma once

#include "shape/placed_grain.h"

namespace lsdcd {

// Returns true only where a plane was found that has the grains on its two sides, by their support functions, to rounding. Grains
// between which no plane is found in 200 steps count as not apart: less than one pair in a thousand that is apart by 1e-9 of
// its size or more.
bool are_apart(const PlacedGrain &a, const PlacedGrain &b);

}    // namespace lsdcd
