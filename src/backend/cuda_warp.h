// What the lanes of a warp on an NVIDIA GPU count together.
#pragma once

#include <cuda_runtime.h>

namespace lsdcd {

constexpr unsigned kAllLanes = 0xffffffffu;

// How many lanes below this one vote yes.
__device__ inline unsigned votes_below(unsigned votes)
{
  return __popc(votes & ((1u << threadIdx.x % 32) - 1));
}

// Room at `end` for n things of a warp, all of whose lanes call this: where it begins.
template <class T>
__device__ T room_at(T *end, unsigned n)
{
  T at = 0;
  if (threadIdx.x % 32 == 0 && n > 0) at = atomicAdd(end, static_cast<T>(n));
  return __shfl_sync(kAllLanes, at, 0);
}

}    // namespace lsdcd
