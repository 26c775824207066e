// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// SplitMix64 (Steele, Lea and Flood 2014): the n-th number of a sequence is split_mix(seed + n * kSplitMixStep).
#pragma once

#include "base/real.h"

#include <cstdint>

namespace lsdcd {

constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;

LSDCD_FN std::uint64_t split_mix(std::uint64_t z)
{
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}    // namespace lsdcd
