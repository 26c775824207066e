// A step over many spheres on an NVIDIA GPU: a thread for each, and a second kernel for those that
// need more than one contact's registers.
#pragma once

#include "parallel/cuda_warp.h"
#include "parallel/lane_group.h"

#include <cuda_runtime.h>

#include <cstddef>

namespace lsdcd {

constexpr unsigned kStepBlock = 128;
constexpr unsigned kLeftBlocks = 528;    // of the second kernel, which share what is left

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

// What the first kernel has left; n >= 0: all of [0, n), where there was no first kernel.
template <class Work>
__global__ void __launch_bounds__(kStepBlock) cuda_several(int n, const __grid_constant__ Work work)
{
  const bool all = n >= 0;
  const int warps = gridDim.x * (kStepBlock / 32), step = 32 * warps;
  const int warp = blockIdx.x * (kStepBlock / 32) + threadIdx.x / 32, lane = threadIdx.x % 32;
  // What is left is few, and each sphere takes a way of its own through the code: first one a warp.
  const int first = all ? 32 * warp + lane : lane * warps + warp;
  if (all && first == 0) work.begin();
  const int end = all ? n : *work.n_left();
  for (int s = first; __any_sync(kAllLanes, s < end); s += step) {
    const bool has_one = s < end;
    const int k = !has_one ? 0 : all ? s : work.left()[s];
    // Lists are long to make: the whole warp makes one after the other.
    unsigned due = __ballot_sync(kAllLanes, has_one && work.needs_list(k));
    for (; due != 0; due &= due - 1)
      work.make_list(LaneGroup<32>(), __shfl_sync(kAllLanes, k, __ffs(due) - 1));
    __syncwarp();
    if (has_one) work.several(k);
    __syncwarp();
  }
}

}    // namespace lsdcd
