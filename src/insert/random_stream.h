// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random numbers that depend on a key alone: nothing has to be kept between steps or in restart files.
#pragma once

#include "base/real.h"

#include <cstdint>
#include <initializer_list>

namespace lsdcd {

// SplitMix64 (Steele, Lea and Flood 2014), begun at a hash of the key.
class RandomStream {
 public:
  RandomStream(std::initializer_list<std::int64_t> key)
  {
    for (const std::int64_t part : key)
      state_ = mixed(state_ + static_cast<std::uint64_t>(part) + kStep);
  }

  // At least 0 and below 1.
  Real uniform() { return 0x1p-53 * static_cast<Real>(mixed(state_ += kStep) >> 11); }
  Real uniform(Real lo, Real hi) { return lo + (hi - lo) * uniform(); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  static std::uint64_t mixed(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_ = 0;
};

}    // namespace lsdcd
