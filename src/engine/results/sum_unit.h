// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Sums in fixed point. Summands are rounded to whole multiples of a unit, so that a sum has the same bits in any order, on any
// number of threads and of processes. The unit is a power of two that follows from the numbers themselves.
#pragma once

#include "backend/bits.h"
#include "base/real.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace lsdcd {

// The position of the exponent field in a Real's bits. |x| < 2^(field - kFieldOfHalf), also if the field is 0.
constexpr int kExponentAt = 52, kFieldOfHalf = 1022;
constexpr unsigned kNotFinite = 2047;    // of infinity, and of a value that is not a number

LSDCD_FN std::uint64_t bits_of(Real x)
{
  std::uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}
LSDCD_FN unsigned exponent_field(Real x)
{
  return static_cast<unsigned>(bits_of(x) >> kExponentAt) & kNotFinite;
}

// What must be known of all numbers before the first one is added.
struct SummandRange {
  std::uint64_t count;       // at least the number of summands of any sum
  std::uint64_t exponent;    // the largest exponent_field()
};

// Let E be the least exponent for which all numbers are below 2^E, and let the count be below 2^b. Then the unit is 2^(E + b -
// 63): each number becomes at most 2^(63 - b) units, because rounding does not pass a whole number, so that a sum, and each part
// of it, has at most (2^b - 1) 2^(63 - b) < 2^63 units and fits into 64 bits. A number is rounded by half a unit at most, which
// is less than 2^(b - 63) of the largest number, as that is at least 2^(E - 1): 2^-43 for 1e6 numbers. Sums of numbers whose 53
// bits lie within 63 - b bits are exact. Units are at least 2^-1022, so that both a unit and its inverse are normal numbers.
class SumUnit {
 public:
  LSDCD_FN explicit SumUnit(const SummandRange &of) : is_finite_(of.exponent < kNotFinite)
  {
    const int e = static_cast<int>(of.exponent) - kFieldOfHalf,
              b = static_cast<int>(exponent_field(static_cast<Real>(of.count))) - kFieldOfHalf;
    const int per_unit = 63 - e - b;
    scale_ = per_unit < kFieldOfHalf ? per_unit : kFieldOfHalf;
  }

  // Returns whether all numbers are finite; otherwise there are no units.
  LSDCD_FN bool is_finite() const { return is_finite_; }
  // Returns the number of units nearest to x.
  LSDCD_FN std::int64_t units(Real x) const { return nearest_whole(x * power_of_two(scale_)); }
  // Returns the number for so many units, rounded to a Real; not a number if the summands are not finite.
  LSDCD_FN Real value(std::int64_t units) const
  {
    if (!is_finite_) return HUGE_VAL - HUGE_VAL;
    return static_cast<Real>(units) * power_of_two(-scale_);
  }

 private:
  LSDCD_FN static Real power_of_two(int e)
  {
    const std::uint64_t bits = static_cast<std::uint64_t>(e + kFieldOfHalf + 1) << kExponentAt;
    Real power;
    memcpy(&power, &bits, sizeof power);
    return power;
  }

  bool is_finite_;
  int scale_;    // a unit is 2^-scale_
};

}    // namespace lsdcd
