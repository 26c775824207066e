// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shapes that were made, by their proportions and exponents.
#pragma once

#include "shape/superellipsoid.h"

#include <array>
#include <cstddef>
#include <map>

namespace lsdcd {

// Makes shapes and keeps them, as the least radius of curvature takes a search.
class ShapesMade {
 public:
  Superellipsoid get(const Vec3 &half, Real n1, Real n2)
  {
    if (n1 == 2 && n2 == 2) return make_superellipsoid(half, n1, n2);
    check_shape(half, n1, n2);    // of what is no number, or all below 0, a key would be found
    const std::array<Real, 4> key = {half.y / half.x, half.z / half.x, n1, n2};
    auto at = made_.find(key);
    if (at == made_.end()) {
      if (made_.size() >= kMost) made_.clear();
      at = made_.emplace(key, make_superellipsoid({1, key[0], key[1]}, n1, n2)).first;
    }
    const Superellipsoid &one = at->second;
    return {half, n1, n2, half.x * one.rho, half.x * one.farthest, half.x * one.nearest};
  }

 private:
  static constexpr std::size_t kMost = 4096;
  std::map<std::array<Real, 4>, Superellipsoid> made_;
};

}    // namespace lsdcd
