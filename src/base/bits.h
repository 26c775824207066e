// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bits of a word, counted and found, on a CPU and on a GPU.
#pragma once

#include "base/real.h"

#include <cstdint>

namespace lsdcd {

LSDCD_FN int count_bits(std::uint64_t word)
{
#if defined(__CUDA_ARCH__)
  return __popcll(word);
#else
  return __builtin_popcountll(word);
#endif
}
LSDCD_FN int count_bits(std::uint32_t word)
{
#if defined(__CUDA_ARCH__)
  return __popc(word);
#else
  return __builtin_popcount(word);
#endif
}

// Of a word that is not 0.
LSDCD_FN unsigned lowest_bit(unsigned word)
{
#if defined(__CUDA_ARCH__)
  return __ffs(word) - 1;
#else
  return __builtin_ctz(word);
#endif
}

}    // namespace lsdcd
