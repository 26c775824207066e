// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres of the paper's study. Each comes from a counter, so that every device makes the same.
#pragma once

#include "base/split_mix.h"
#include "query/sphere.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Returns the counter-th number of a SplitMix64 sequence, in (0, 1]: a multiple of 2^-53. Integers and one exact product:
// the same bits everywhere.
LSDCD_FN Real uniform(std::uint64_t seed, std::uint64_t counter)
{
  const std::uint64_t z = split_mix(seed + (counter + 1) * kSplitMixStep);
  return static_cast<Real>((z >> 11) + 1) * Real(0x1p-53);
}

// Centres uniform in the box between lo and hi, radii uniform in (0, largest]. Lengths.
struct SphereBox {
  Vec3 lo, hi;
  Real largest;
  std::uint64_t seed;

  LSDCD_FN Sphere sphere(std::uint64_t i) const
  {
    const Vec3 u = {uniform(seed, 4 * i), uniform(seed, 4 * i + 1), uniform(seed, 4 * i + 2)};
    return {lo.x + (hi.x - lo.x) * u.x, lo.y + (hi.y - lo.y) * u.y, lo.z + (hi.z - lo.z) * u.z,
            largest * uniform(seed, 4 * i + 3)};
  }
};

// Returns the position of a point of the box along a Z-curve with 1024 steps per side.
std::uint32_t number_on_curve(const SphereBox &box, const Vec3 &at);

enum class Order { random, sorted };

// The first n spheres of a box, as they come or sorted along the curve.
std::vector<Sphere> make_spheres(const SphereBox &box, std::size_t n, Order order);

}    // namespace lsdcd
