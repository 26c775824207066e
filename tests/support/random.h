// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random numbers and directions for tests.
#pragma once

#include "base/vec3.h"

#include <cmath>
#include <random>

namespace lsdcd {

using Random = std::mt19937_64;

inline Real uniform(Random &random, Real lo, Real hi)
{
  return std::uniform_real_distribution<Real>(lo, hi)(random);
}

inline Vec3 uniform(Random &random, const Vec3 &lo, const Vec3 &hi)
{
  return {uniform(random, lo.x, hi.x), uniform(random, lo.y, hi.y), uniform(random, lo.z, hi.z)};
}

// A number of any size between two that are above 0.
inline Real log_uniform(Random &random, Real lo, Real hi)
{
  return std::exp(uniform(random, std::log(lo), std::log(hi)));
}

inline Vec3 unit(const Vec3 &a)
{
  return (1 / norm(a)) * a;
}

inline Vec3 random_unit(Random &random)
{
  std::normal_distribution<Real> normal;
  const Vec3 a = {normal(random), normal(random), normal(random)};
  return (1 / norm(a)) * a;
}

}    // namespace lsdcd
