// Threads of a GPU that search one list together, each a part of it; on a CPU a single thread.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// kSize_: a power of 2 up to 32. All threads of a group must call its functions together.
template <unsigned kSize_>
struct LaneGroup {
  static constexpr unsigned kSize = kSize_;
  static constexpr unsigned kAll = kSize == 32 ? ~0u : (1u << kSize) - 1;

  LSDCD_FN static unsigned rank()
  {
#if defined(__CUDA_ARCH__)
    return threadIdx.x % kSize;
#else
    return 0;
#endif
  }
  // A bit for each thread that says yes.
  LSDCD_FN static unsigned vote(bool yes)
  {
#if defined(__CUDA_ARCH__)
    if constexpr (kSize > 1) {
      const unsigned begin = threadIdx.x % 32 / kSize * kSize;
      return __ballot_sync(kAll << begin, yes) >> begin & kAll;
    }
#endif
    return yes;
  }
  // What the thread of this rank has.
  template <class T>
  LSDCD_FN static T of(T value, unsigned rank)
  {
#if defined(__CUDA_ARCH__)
    if constexpr (kSize > 1)
      return __shfl_sync(kAll << threadIdx.x % 32 / kSize * kSize, value, rank, kSize);
#endif
    (void) rank;
    return value;
  }
  // Rank of the first of some votes.
  LSDCD_FN static unsigned first(unsigned votes)
  {
#if defined(__CUDA_ARCH__)
    return __ffs(votes) - 1;
#else
    return __builtin_ctz(votes);
#endif
  }
};

}    // namespace lsdcd
