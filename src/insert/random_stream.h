// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random numbers that depend on a key alone: nothing has to be stored between steps or in restart files.
#pragma once

#include "base/split_mix.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace lsdcd {

// A sequence that begins at a hash of the key.
class RandomStream {
 public:
  RandomStream(std::initializer_list<std::int64_t> key)
  {
    for (const std::int64_t part : key)
      state_ = split_mix(state_ + static_cast<std::uint64_t>(part) + kSplitMixStep);
  }

  // At least 0 and below 1.
  Real uniform() { return 0x1p-53 * static_cast<Real>(split_mix(state_ += kSplitMixStep) >> 11); }
  Real uniform(Real lo, Real hi) { return lo + (hi - lo) * uniform(); }
  // Returns a number of the normal distribution with the mean 0 and the standard deviation 1 (Box and Muller 1958).
  Real gaussian()
  {
    const Real r = std::sqrt(-2 * std::log(1 - uniform()));
    return r * std::cos(2 * kPi * uniform());
  }

 private:
  std::uint64_t state_ = 0;
};

}    // namespace lsdcd
