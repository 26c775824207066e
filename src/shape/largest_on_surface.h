// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The largest value of a function on the surface of a superellipsoid.
#pragma once

#include "shape/superellipsoid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace lsdcd {

// Finds the largest value of a function of points of the surface, which is the same in each octant, by two angles from 0 to pi/2.
template <class Value>
class LargestOnSurface {
 public:
  LargestOnSurface(const Superellipsoid &s, const Value &value) : s_(s), value_(value) {}

  // Scans the octant, and goes uphill from the highest of the angles that are above their neighbours.
  Real find() const
  {
    std::vector<Real> scan((kSteps + 1) * (kSteps + 1));
    for (int i = 0; i <= kSteps; i++)
      for (int j = 0; j <= kSteps; j++) scan[i * (kSteps + 1) + j] = at(i * kStep, j * kStep);
    std::vector<std::array<Real, 3>> tops;
    for (int i = 0; i <= kSteps; i++)
      for (int j = 0; j <= kSteps; j++) {
        const Real here = scan[i * (kSteps + 1) + j];
        bool is_top = true;
        for (int k = std::max(i - 1, 0); k <= std::min(i + 1, kSteps); k++)
          for (int l = std::max(j - 1, 0); l <= std::min(j + 1, kSteps); l++)
            is_top &= !(scan[k * (kSteps + 1) + l] > here);
        if (is_top) tops.push_back({here, i * kStep, j * kStep});
      }
    constexpr std::size_t kMostTops = 4;
    const std::size_t n = std::min(tops.size(), kMostTops);
    std::partial_sort(tops.begin(), tops.begin() + static_cast<std::ptrdiff_t>(n), tops.end(),
                      std::greater<>());
    Real most = 0;
    for (std::size_t i = 0; i < n; i++) {
      Real up = tops[i][1], round = tops[i][2];
      const Real top = uphill(up, round, tops[i][0]), along = along_ridge(up, round, top);
      most = std::max(most, along > top * (1 + kRounding) ? along : top);
    }
    return most;
  }

 private:
  static constexpr int kSteps = 48;    // rounded edges of exponent 20 are three of them wide
  static constexpr Real kStep = kPi / 2 / kSteps;

  static constexpr Real kSame = 1e-10, kSmallest = 1e-6;    // a top is flat to 1e-12 there
  static constexpr Real kRounding = 1e-9;                   // of what both ways uphill find
  static constexpr int kMostRounds = 100;

  // Halves the step where none of eight goes uphill.
  Real uphill(Real &up, Real &round, Real best) const
  {
    Real by = kStep / 2;
    for (int i_round = 0; i_round < kMostRounds && by > kSmallest; i_round++) {
      const Real from_up = up, from_round = round, before = best;
      for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
          const Real here = at(from_up + i * by, from_round + j * by);
          if (here > best) best = here, up = from_up + i * by, round = from_round + j * by;
        }
      if (!(best > before * (1 + kSame))) by /= 2;
    }
    return best;
  }
  // Goes on along a narrow ridge between the eight directions, by steps of Newton's method, in which slopes and bends are those
  // of a cross of nine points and all bends count as downhill. The top may lie on the border of the octant, as across each
  // of its planes the surface is the same.
  Real along_ridge(Real up, Real round, Real best) const
  {
    Real by = kStep / 64;
    for (int i_round = 0; i_round < kMostRounds && by > kSmallest; i_round++) {
      const auto f = [&](int i, int j) { return mirrored(up + i * by, round + j * by); };
      const Real east = f(0, 1), west = f(0, -1), north = f(1, 0), south = f(-1, 0),
                 g_up = (north - south) / 2, g_round = (east - west) / 2,
                 h_up = north + south - 2 * best, h_round = east + west - 2 * best,
                 h_both = (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / 4;
      // The principal directions of the bends.
      const Real angle = std::atan2(2 * h_both, h_up - h_round) / 2, c = std::cos(angle),
                 s = std::sin(angle);
      const auto step = [&](Real g, Real h) {
        constexpr Real kLongest = 16;
        const Real way = h == 0 ? 0 : g / std::fabs(h);
        return std::max(-kLongest, std::min(kLongest, way));
      };
      const Real mean = (h_up + h_round) / 2,
                 apart = std::sqrt((h_up - h_round) * (h_up - h_round) / 4 + h_both * h_both),
                 first = step(c * g_up + s * g_round, mean + apart),
                 second = step(-s * g_up + c * g_round, mean - apart);
      const Real before = best;
      for (Real share = 1; share > 1e-2; share /= 2) {
        const Real to_up = up + share * by * (c * first - s * second),
                   to_round = round + share * by * (s * first + c * second),
                   here = mirrored(to_up, to_round);
        if (!(here > best)) continue;
        best = here, up = to_up, round = to_round;
        break;
      }
      if (!(best > before * (1 + kSame))) by /= 4;
    }
    return best;
  }
  Real mirrored(Real up, Real round) const
  {
    const auto in_octant = [](Real angle) {
      const Real turned = std::fabs(std::remainder(angle, kPi));
      return std::min(turned, kPi / 2);
    };
    return at(in_octant(up), in_octant(round));
  }
  Real at(Real up, Real round) const
  {
    if (up < 0 || up > kPi / 2 || round < 0 || round > kPi / 2) return 0;
    const Vec3 x = {s_.half.x * std::cos(up) * std::cos(round),
                    s_.half.y * std::cos(up) * std::sin(round), s_.half.z * std::sin(up)};
    return value_((1 / gauge_value(s_, x)) * x);
  }

  const Superellipsoid &s_;
  const Value &value_;
};

// Returns the largest value(x) of points x of the surface, to 1e-9 or so, if it is the same in each octant and above 0.
template <class Value>
Real largest_on_surface(const Superellipsoid &s, const Value &value)
{
  return LargestOnSurface<Value>(s, value).find();
}

}    // namespace lsdcd
