// Work for few things on an NVIDIA GPU, and for few beside many, where only the device
// knows how many there are.
#pragma once

#include "parallel/cuda_early.h"
#include "parallel/rows_together.h"

#include <cstddef>

namespace lsdcd {

// Warps that share few things, 128 registers to a thread. Things differ in what they need:
// spread one to a warp they do not wait for each other.
constexpr unsigned kFewWarps = 2048, kFewAtOnce = 16;

// work.few(s) for s in [0, work.n_few()), and when all are done work.last(lane) for the
// lanes of a warp; work.ended() counts, from 0, the warps that are done.
template <class Work>
__global__ void __launch_bounds__(32, kFewAtOnce) cuda_few(const __grid_constant__ Work work)
{
  let_next_begin();
  const std::size_t n = work.n_few();
  const unsigned busy = n < gridDim.x ? static_cast<unsigned>(n) : gridDim.x;
  if (blockIdx.x >= busy) return;
  for (std::size_t s = blockIdx.x + std::size_t(threadIdx.x) * gridDim.x; s < n;
       s += std::size_t(32) * gridDim.x)
    work.few(s);
  __threadfence();
  __syncwarp();
  unsigned ended = 0;
  if (threadIdx.x == 0) ended = atomicAdd(work.ended(), 1u) + 1;
  if (__shfl_sync(~0u, ended, 0) < busy) return;
  __threadfence();
  if (threadIdx.x < Work::kLastLanes) work.last(threadIdx.x);
}

constexpr unsigned kManyBlock = kMostTogether;
constexpr std::size_t kFewLanes = 1 << 16;    // that share few things beside many

// work.many(i) for i in [0, n), n a multiple of 32, and at once work.few(s) for s in
// [0, work.n_few()) by the first blocks, which alone need the kernel before this one to have
// ended. One of them waits for it whatever there is to do: a kernel must not end before the
// one that it began beside.
template <class Work>
__global__ void __launch_bounds__(kManyBlock, Work::kBlocksAtOnce)
    cuda_few_and_many(std::size_t n, unsigned few_blocks, const __grid_constant__ Work work)
{
  if (blockIdx.x >= few_blocks) {
    const std::size_t i = std::size_t(blockIdx.x - few_blocks) * kManyBlock + threadIdx.x;
    if (i < n) work.many(i);
    return;
  }
  const std::size_t n_few = work.n_few(), first = std::size_t(blockIdx.x) * kManyBlock;
  if (blockIdx.x > 0 && first >= n_few) return;
  wait_for_last_kernel();
  for (std::size_t s = first + threadIdx.x; s < n_few; s += std::size_t(few_blocks) * kManyBlock)
    work.few(s);
}

}    // namespace lsdcd
