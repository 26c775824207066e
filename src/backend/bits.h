// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bits of a word, counted and found, and whole numbers: what a CPU and a GPU each do in a way of their own.
#pragma once

#include "base/real.h"

#include <cmath>
#include <cstdint>
#if defined(__SSE2__) && defined(__x86_64__)
#include <emmintrin.h>
#endif

// Is this compiled for the device? For #if, where a macro that is not known would be 0 without its brackets.
#if defined(__CUDA_ARCH__)
#define LSDCD_ON_GPU() 1
#else
#define LSDCD_ON_GPU() 0
#endif

namespace lsdcd {

LSDCD_FN int count_bits(std::uint64_t word)
{
#if LSDCD_ON_GPU()
  return __popcll(word);
#else
  // Of pairs, of fours, of bytes, of all; what a compiler has for it is a call where it may not use the instruction.
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  word = (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0f;
  return static_cast<int>(word * 0x0101010101010101 >> 56);
#endif
}
LSDCD_FN int count_bits(std::uint32_t word)
{
#if LSDCD_ON_GPU()
  return __popc(word);
#else
  return count_bits(std::uint64_t(word));
#endif
}

// The number of the lowest bit that is set, in a word that is not 0.
LSDCD_FN unsigned lowest_bit(unsigned word)
{
#if LSDCD_ON_GPU()
  return __ffs(word) - 1;
#else
  return __builtin_ctz(word);
#endif
}

// Returns the whole number nearest to x, the even one of two; |x| < 2^63.
LSDCD_FN std::int64_t nearest_whole(Real x)
{
#if LSDCD_ON_GPU()
  return __double2ll_rn(x);
#elif defined(__SSE2__) && defined(__x86_64__)
  return _mm_cvtsd_si64(_mm_set_sd(x));    // llrint() is a call, as it may set errno
#else
  return std::llrint(x);
#endif
}

// The largest whole number at or below x, where it is at least 0 and has 32 bits; elsewhere, and
// where x is not a number, `fits` is false. No branch but one that nearly all points take: one on
// how x rounds would be guessed wrong every second time. On a GPU, from 2^52 on doubles are whole
// numbers: their low word is the number, at 2^52 more than x, in one step where comparing and
// converting take many.
struct WholeNumber {
  bool fits;
  std::uint32_t value;
  Real real;    // the same
};
LSDCD_FN WholeNumber whole_below(Real x)
{
#if LSDCD_ON_GPU()
  constexpr Real kFromHereWhole = 4503599627370496.;
  const Real sum = __dadd_rd(x, kFromHereWhole);
  const std::uint64_t bits = __double_as_longlong(sum);
  return {bits >> 32 == 0x43300000u, static_cast<std::uint32_t>(bits), sum - kFromHereWhole};
#else
  const bool fits = x >= 0 && x < Real(4294967296.);
  const std::int64_t whole = fits ? static_cast<std::int64_t>(x) : 0;
  return {fits, static_cast<std::uint32_t>(whole), static_cast<Real>(whole)};
#endif
}

}    // namespace lsdcd
