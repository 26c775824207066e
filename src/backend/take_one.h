// A place at the end of an array that many threads fill, in any order.
#pragma once

#include "base/real.h"

#include <cstdint>

namespace lsdcd {

// Adds 1; returns what was there before.
LSDCD_FN std::uint64_t take_one(std::uint64_t *end)
{
#if defined(__CUDA_ARCH__)
  // One addition for all lanes that are here: thousands to one number would wait for each other.
  const unsigned lanes = __activemask(), lane = threadIdx.x % 32;
  const unsigned first = __ffs(lanes) - 1;
  unsigned long long begin = 0;
  if (lane == first) begin = atomicAdd(reinterpret_cast<unsigned long long *>(end), __popc(lanes));
  return __shfl_sync(lanes, begin, first) + __popc(lanes & ((1u << lane) - 1));
#else
  return __atomic_fetch_add(end, 1, __ATOMIC_RELAXED);
#endif
}

}    // namespace lsdcd
