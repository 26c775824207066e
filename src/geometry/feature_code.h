// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Names of the parts of a wall: faces, edges and vertices in one 32-bit number.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// The feature of the wall that a contact is on: its kind in the two top bits, its index below.
using FeatureCode = std::uint32_t;
enum class FeatureKind : std::uint32_t { face = 0, edge = 1, vertex = 2 };

constexpr int kFeatureIndexBits = 30;
constexpr FeatureCode kFeatureIndexMask = 0x3fffffffu;
constexpr FeatureCode kNoFeature = 0xffffffffu;
constexpr std::size_t kMaxFeatures = kFeatureIndexMask;

LSDCD_FN FeatureCode feature_code(FeatureKind kind, std::uint32_t index)
{
  return (static_cast<std::uint32_t>(kind) << 30) | index;
}
LSDCD_FN FeatureKind feature_kind(FeatureCode code)
{
  return static_cast<FeatureKind>(code >> 30);
}
LSDCD_FN std::uint32_t feature_index(FeatureCode code)
{
  return code & kFeatureIndexMask;
}

}    // namespace lsdcd
