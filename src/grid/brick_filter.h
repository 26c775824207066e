// Which points may lie in a brick, told by as little arithmetic as can be: a GPU asks this of
// every sphere, and in float it costs a third of what it costs in double.
#pragma once

#include "grid/brick_words.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace lsdcd {

// A point's brick by its place in the table, as far as that is sure.
struct BrickGuess {
  bool unsure;            // the rest may be wrong
  bool inside;            // of the grid
  std::uint32_t place;    // set where inside
};

// For points whose coordinates are of type T.
template <class T>
struct BrickFilter;

// Sure, and what brick_place_of() says.
template <>
struct BrickFilter<Real> {
  BrickFilter() = default;
  explicit BrickFilter(const GridView &) {}

  LSDCD_FN BrickGuess guess(const GridView &grid, const Vec3 &q) const
  {
    const std::uint32_t place = brick_place_of(grid, q).place;
    return {false, place != kNoBrick, place};
  }
};

// Counts bricks from the grid's corner in fixed point: a float between B and 2 B, B = 2^(23 - s),
// has s bits behind the point, and B and the corner are part of one number `from` that is added
// to a coordinate times `scale`, rounded once. The result is off by less than `doubt` / 2 of the
// last bit, which `from` has more; so a fraction from `doubt` on has the brick's number before
// it, and where a fraction is below, the point is next to a brick's side, or so far away that no
// fraction is left. Bits past the largest brick's, and of numbers below B, are too large.
//
// How far off, for a point inside of the grid, in bricks: `scale` is the nearest float, so
// |x| |scale - exact|, with |x| up to the grid's far side; `from`, the nearest float to a number
// below |first| + 2 B, 2^-24 of that; the result, below 4 B, as far as 2^-24 of 4 B; and what
// place_of() rounds in double, three times in numbers up to n and once in `first`. The result
// grows with the coordinate: a point outside comes out past the grid's side, or as near to it.
template <>
struct BrickFilter<float> {
  float scale = 0, from[3] = {0, 0, 0};
  std::uint32_t base = 0, end[3] = {0, 0, 0};    // bits of B; fixed point
  std::uint32_t sure = 0;                        // bits of a fraction that make it sure; 0: never
  std::uint32_t shift = 1;                       // s

  BrickFilter() = default;
  explicit BrickFilter(const GridView &grid)
  {
    constexpr Real kFloatRoundoff = 5.9604644775390625e-8;    // 2^-24
    const Real largest = Real(*std::max_element(grid.n_bricks, grid.n_bricks + 3));
    shift = 23;
    while (shift > 1 && std::ldexp(largest, static_cast<int>(shift)) > 0x1p23) shift--;
    const Real unit = std::ldexp(Real(1), -static_cast<int>(shift)), bias = 0x1p23 * unit;
    const Real per_length = grid.inv_length / kBrickSide;
    scale = static_cast<float>(per_length);

    Real off = 0;
    for (int k = 0; k < 3; k++) {
      const Real first = -grid.origin[k] * per_length,
                 far = fabs(grid.origin[k]) + grid.n_bricks[k] * kBrickSide * grid.length;
      off = fmax(off, far * (1 + 8 * kRoundoff) * fabs(scale - per_length) +
                          kFloatRoundoff * (fabs(first) + 6 * bias) +
                          8 * kRoundoff * (fabs(first) + grid.n_bricks[k]));
    }
    std::uint32_t doubt_bits = 1;
    while (doubt_bits < shift && std::ldexp(unit, static_cast<int>(doubt_bits)) < 2 * off)
      doubt_bits++;
    for (int k = 0; k < 3; k++) {
      const Real first = -grid.origin[k] * per_length;
      from[k] =
          static_cast<float>(bias + first + std::ldexp(unit, static_cast<int>(doubt_bits) - 1));
      end[k] = static_cast<std::uint32_t>(grid.n_bricks[k]) << shift;
    }
    base = bits_of(static_cast<float>(bias));
    // None are left where the grid has too many bricks, lies too far off, or has a scale that is
    // no float.
    sure = (1u << shift) - (1u << doubt_bits);
  }

  LSDCD_FN BrickGuess guess(const GridView &grid, const Vec3Of<float> &q) const
  {
    const std::uint32_t i = bits_of(std::fma(q.x, scale, from[0])) - base,
                        j = bits_of(std::fma(q.y, scale, from[1])) - base,
                        k = bits_of(std::fma(q.z, scale, from[2])) - base;
    const std::uint32_t nx = grid.n_bricks[0], ny = grid.n_bricks[1];
    const bool unsure = (i & sure) == 0 || (j & sure) == 0 || (k & sure) == 0,
               inside = i < end[0] && j < end[1] && k < end[2];
    return {unsure, inside, ((k >> shift) * ny + (j >> shift)) * nx + (i >> shift)};
  }

 private:
  LSDCD_FN static std::uint32_t bits_of(float x)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
  }
};

}    // namespace lsdcd
