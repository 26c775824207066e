// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The ranges of single numbers of a WallSpec. Units are in wall_spec.h.
#pragma once

#include "base/input_words.h"
#include "grid/triangle_grid.h"

#include <limits>

namespace lsdcd {

constexpr NumberRange kAbove0 = {kAboveZero, Tokens::kHuge}, kNotBelow0 = {0, Tokens::kHuge};

// Of the search.
constexpr NumberRange kCellRange = kAbove0, kNearestRange = {1, kMaxNearest};
// Of files, means and worn meshes that are due every so many steps.
constexpr NumberRange kStepsRange = {1, std::numeric_limits<int>::max()};
constexpr NumberRange kWearCoefficientRange = kNotBelow0, kHardnessRange = kAbove0,
                      kWearDeformFactorRange = kAbove0, kWearFactorRange = kNotBelow0;
constexpr NumberRange kShareRange = {0, 1};
constexpr NumberRange kPeriodRange = kAbove0;
constexpr NumberRange kServoSpeedRange = kAbove0, kServoGainRange = kAbove0,
                      kServoLoRange = {-Tokens::kHuge, 0}, kServoHiRange = kNotBelow0;

}    // namespace lsdcd
