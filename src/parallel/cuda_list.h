// Sorting things into lists on an NVIDIA GPU.
#pragma once

#include "parallel/cuda_warp.h"

#include <cuda_runtime.h>

#include <cstddef>

namespace lsdcd {

// Threads of a block, and blocks at once on a processor: 80 registers are left to a thread.
constexpr unsigned kListBlock = 128, kListBlocks = 6;

// Work::find() says into which of kLists lists a thing goes, -1 for none, from what
// Work::read() has read of it, and Work::keep() is told its place there. All threads read
// together; those past the end the last thing once more. The lists grow by a block of threads
// at a time: one atomic addition each, and neighbours stay together.
template <int kLists, class Work>
__global__ void __launch_bounds__(kListBlock, kListBlocks)
    cuda_list(std::size_t n, const __grid_constant__ Work work, int *listed)
{
  __shared__ int of_block[kLists], before_block[kLists];
  if (threadIdx.x < kLists) of_block[threadIdx.x] = 0;
  __syncthreads();
  const std::size_t i = std::size_t(blockIdx.x) * kListBlock + threadIdx.x;
  typename Work::Item item;
  work.read(i < n ? i : n - 1, item);
  const int list = i < n ? work.find(i, item) : -1;
  int at = 0;
#pragma unroll
  for (int l = 0; l < kLists; l++) {
    const unsigned vote = __ballot_sync(kAllLanes, list == l);
    const int first = room_at(&of_block[l], __popc(vote));
    if (list == l) at = first + static_cast<int>(votes_below(vote));
  }
  __syncthreads();
  if (threadIdx.x < kLists && of_block[threadIdx.x] > 0)
    before_block[threadIdx.x] = atomicAdd(&listed[threadIdx.x], of_block[threadIdx.x]);
  __syncthreads();
  if (i < n) work.keep(list, list >= 0 ? before_block[list] + at : -1, i, item);
}

}    // namespace lsdcd
