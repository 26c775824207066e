// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A test whether a point may lie in a brick, with as little arithmetic as possible: a GPU tests every
// sphere.
#pragma once

#include "grid/lookup/brick_words.h"
#include "grid/lookup/coarse_table.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace lsdcd {

// The brick of a point, if that is sure.
struct BrickGuess {
  bool unsure;              // the rest may be wrong
  bool inside;              // of the grid
  std::uint32_t i, j, k;    // its brick, in fixed point, set where inside
};

// Numbers that count bricks in fixed point. kBits: how many bits of a mantissa are used.
template <class T>
struct FixedPoint;

template <>
struct FixedPoint<float> {
  static constexpr int kMantissa = 23, kBits = 23;
  static constexpr Real kUnit = 5.9604644775390625e-8;    // 2^-24: of rounding

  // Returns the bits of `sum` past those of `bias`; too large where it is below, or not a number.
  LSDCD_FN static std::uint32_t past(float sum, float bias) { return bits_of(sum) - bits_of(bias); }

 private:
  LSDCD_FN static std::uint32_t bits_of(float x)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }
};

template <>
struct FixedPoint<double> {
  static constexpr int kMantissa = 52, kBits = 31;
  static constexpr Real kUnit = 1.1102230246251565e-16;    // 2^-53

  // The same; its low word, where the high one is that of `bias`.
  LSDCD_FN static std::uint32_t past(double sum, double bias)
  {
    const std::uint64_t bits = bits_of(sum);
    return bits >> 32 == bits_of(bias) >> 32 ? static_cast<std::uint32_t>(bits) : 0xffffffffu;
  }

 private:
  LSDCD_FN static std::uint64_t bits_of(double x)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }
};

// For points whose coordinates are of type T. The number of a brick, from the grid's corner, in fixed point:
//
//   y = x * scale + from,  B <= y < 2 B,  B = 2^(mantissa bits - s)
//
// is rounded once. Its last s bits are the fraction of a brick, those before them the brick's number; `from` holds
// B and the corner. |y - exact| < doubt / 2 units of the last bit, and `from` has doubt / 2 units more. So
//
//   fraction >= doubt: the brick's number is right;
//   fraction < doubt: the point is next to a brick's side, or so far away that no fraction is left.
//
// Bits past the largest brick's, and bits of y < B, give numbers that are too large.
//
// The error of y for a point inside of the grid, in bricks, is at most the sum of
//   |x| |scale - exact|, as `scale` is the nearest T, with |x| up to the grid's far side;
//   the rounding of `from`, which is below |first| + 2 B;
//   the rounding of y, which is below 4 B;
//   the roundings of cell_index_of() in double, three of numbers up to n and one of `first`.
// y grows with x: for a point outside it is past the grid's side, or as near to it.
template <class T>
struct BrickFilter {
  using Fixed = FixedPoint<T>;

  T scale = 0, bias = 1, from[3] = {0, 0, 0};
  std::uint32_t end[3] = {0, 0, 0};    // fixed point
  std::uint32_t sure = 0;              // bits of a fraction that make it sure; 0: never
  std::uint32_t shift = 1;             // s
  std::uint32_t doubt = 1;             // how far off a result is at most, twice

  BrickFilter() = default;
  explicit BrickFilter(const GridView &grid)
  {
    const Real largest = Real(*std::max_element(grid.n_bricks, grid.n_bricks + 3));
    shift = Fixed::kBits - 1;
    while (shift > 1 &&
           std::ldexp(largest, static_cast<int>(shift)) > std::ldexp(Real(1), Fixed::kBits))
      shift--;
    const Real unit = std::ldexp(Real(1), -static_cast<int>(shift)),
               least = std::ldexp(unit, Fixed::kMantissa);
    const Real per_length = grid.inv_length / kBrickSide;
    scale = static_cast<T>(per_length);

    Real off = 0;
    for (int k = 0; k < 3; k++) {
      const Real first = -grid.origin[k] * per_length,
                 far = fabs(grid.origin[k]) + grid.n_bricks[k] * kBrickSide * grid.length;
      off = fmax(off, far * (1 + 8 * kRoundoff) * fabs(scale - per_length) +
                          Fixed::kUnit * (fabs(first) + 6 * least) +
                          8 * kRoundoff * (fabs(first) + grid.n_bricks[k]));
    }
    std::uint32_t doubt_bits = 1;
    while (doubt_bits < shift && std::ldexp(unit, static_cast<int>(doubt_bits)) < 2 * off)
      doubt_bits++;
    for (int k = 0; k < 3; k++) {
      const Real first = -grid.origin[k] * per_length;
      from[k] = static_cast<T>(least + first + std::ldexp(unit, static_cast<int>(doubt_bits) - 1));
      end[k] = static_cast<std::uint32_t>(grid.n_bricks[k]) << shift;
    }
    bias = static_cast<T>(least);
    // There are none if the grid has too many bricks, is too far from the origin, or has a scale
    // that is no T.
    sure = (1u << shift) - (1u << doubt_bits);
    doubt = 1u << doubt_bits;
  }

  LSDCD_FN BrickGuess guess(const Vec3Of<T> &q) const
  {
    const std::uint32_t i = Fixed::past(std::fma(q.x, scale, from[0]), bias),
                        j = Fixed::past(std::fma(q.y, scale, from[1]), bias),
                        k = Fixed::past(std::fma(q.z, scale, from[2]), bias);
    const bool unsure = (i & sure) == 0 || (j & sure) == 0 || (k & sure) == 0,
               inside = i < end[0] && j < end[1] && k < end[2];
    return {unsure, inside, i, j, k};
  }
  // Returns a margin, in bricks, for is_clear(). 0: it is more than half a brick.
  std::uint32_t margin(Real bricks) const
  {
    const Real fixed = std::ceil(std::ldexp(bricks, static_cast<int>(shift))) + 2. * doubt;
    return fixed < std::ldexp(Real(0.5), static_cast<int>(shift))
               ? static_cast<std::uint32_t>(fixed)
               : 0;
  }
  // Is a point that is inside farther than a margin, not 0, from all sides of its brick?
  LSDCD_FN bool is_clear(const BrickGuess &at, std::uint32_t margin) const
  {
    const std::uint32_t mask = (1u << shift) - 1, room = mask - 2 * margin;
    return (at.i & mask) - margin <= room && (at.j & mask) - margin <= room &&
           (at.k & mask) - margin <= room;
  }

  // The index in the table of a brick that is inside.
  LSDCD_FN std::uint32_t index(const GridView &grid, const BrickGuess &at) const
  {
    const std::uint32_t nx = grid.n_bricks[0], ny = grid.n_bricks[1];
    return ((at.k >> shift) * ny + (at.j >> shift)) * nx + (at.i >> shift);
  }
  // The index in a coarse table of a brick that is inside.
  LSDCD_FN std::uint32_t index(const CoarseTable &table, const BrickGuess &at) const
  {
    const std::uint32_t down = shift + table.shift;
    return table.index(at.k >> down, at.j >> down, at.i >> down);
  }
};

}    // namespace lsdcd
