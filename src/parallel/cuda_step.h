// A step over many spheres on an NVIDIA GPU: a thread for each, and a second kernel for those that
// need more than one contact's registers.
#pragma once

#include "parallel/cuda_warp.h"

#include <cuda_runtime.h>

#include <cstddef>

namespace lsdcd {

constexpr unsigned kStepBlock = 128;
constexpr unsigned kSeveralBlocks = 528;    // of the second kernel, which share what is left

template <class Work>
__global__ void __launch_bounds__(kStepBlock, Work::kBlocksAtOnce)
    cuda_single(unsigned n, const __grid_constant__ Work work)
{
  const unsigned k = blockIdx.x * kStepBlock + threadIdx.x;
  if (k == 0) work.begin();
  const bool left = k < n && !work.single(k);
  const unsigned votes = __ballot_sync(kAllLanes, left);
  if (votes == 0) return;
  const int at = room_at(work.n_left(), __popc(votes));
  if (left) work.left()[at + votes_below(votes)] = static_cast<int>(k);
}

template <class Work>
__global__ void __launch_bounds__(kStepBlock) cuda_several(const __grid_constant__ Work work)
{
  const int n = *work.n_left();
  for (int s = blockIdx.x * kStepBlock + threadIdx.x; s < n; s += gridDim.x * kStepBlock)
    work.several(work.left()[s]);
}

}    // namespace lsdcd
