// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The last part of a choice on a GPU: from bits to a list.
#pragma once

#include "engine/choose/refine_cuda.h"

#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>
#include <cuda_runtime.h>

#include <cstdint>

namespace lsdcd {

// From bits to a list of spheres. Each block counts the bits of its words, waits for the counts of the blocks
// before it, and writes its own. *total becomes how many there are, or kNoRoom where a list of the first part
// had too little room.
constexpr std::uint32_t kNoRoom = ~std::uint32_t(0);
constexpr unsigned kGatherBlock = 1024;
struct GatherCounts {
  volatile unsigned long long *of_block;    // low word: its count; high word: the turn
  unsigned turn;                            // another one for each launch
};
__global__ static void __launch_bounds__(kGatherBlock)
    gather_marked(const unsigned *words, unsigned n_words, unsigned each, const GatherCounts counts,
                  const CandidateLists list, int *to, std::uint32_t *total)
{
  using Sum = cub::BlockReduce<unsigned, kGatherBlock>;
  using Scan = cub::BlockScan<unsigned, kGatherBlock>;
  __shared__ union {
    typename Sum::TempStorage sum;
    typename Scan::TempStorage scan;
  } shared;
  __shared__ unsigned before;
  const unsigned begin = blockIdx.x * each, end = min(begin + each, n_words);
  unsigned n = 0;
  for (unsigned w = begin + threadIdx.x; w < end; w += kGatherBlock) n += __popc(words[w]);
  n = Sum(shared.sum).Sum(n);
  if (threadIdx.x == 0)
    counts.of_block[blockIdx.x] = static_cast<unsigned long long>(counts.turn) << 32 | n;
  __syncthreads();

  // Blocks begin in the order of their numbers, so that those before this one are at work or done.
  unsigned ahead = 0;
  for (unsigned b = threadIdx.x; b < blockIdx.x; b += kGatherBlock) {
    unsigned long long counted = 0;
    do counted = counts.of_block[b];
    while (counted >> 32 != counts.turn);
    ahead += static_cast<unsigned>(counted);
  }
  ahead = Sum(shared.sum).Sum(ahead);
  if (threadIdx.x == 0) before = ahead;
  if (blockIdx.x == gridDim.x - 1 && threadIdx.x < kWarpSize) {
    const bool was_short = list.length && list.empty();
    if (threadIdx.x == 0) *total = was_short ? kNoRoom : ahead + n;
  }
  __syncthreads();

  int *next = to + before;
  for (unsigned first = begin; first < end; first += kGatherBlock) {
    const unsigned w = first + threadIdx.x, word = w < end ? words[w] : 0;
    unsigned at, all;
    Scan(shared.scan).ExclusiveSum(__popc(word), at, all);
    __syncthreads();
    for (unsigned left = word; left != 0; left &= left - 1)
      next[at++] = static_cast<int>(w * 32 + __ffs(left) - 1);
    next += all;
  }
}

}    // namespace lsdcd
