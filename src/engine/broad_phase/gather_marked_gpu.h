// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The last part of the broad phase on a GPU: from bits to a list.
#pragma once

#include "engine/broad_phase/refine_gpu.h"

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
struct GatherMarked {
  static constexpr unsigned kThreads = kGatherBlock, kBlocksAtOnce = 1;

  const unsigned *words;
  unsigned n_words, each;    // words of all blocks, and of each
  GatherCounts counts;
  CandidateLists list;
  int *to;
  std::uint32_t *total;

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    using Sums = BlockSums<kGatherBlock>;
    LSDCD_SHARED typename Sums::Memory memory;
    LSDCD_SHARED unsigned before;
    Sums sums(memory);
    const unsigned begin = block.number() * each, end = min(begin + each, n_words);
    unsigned n = 0;
    for (unsigned w = begin + block.thread(); w < end; w += kGatherBlock) n += count_bits(words[w]);
    n = sums.sum(n);
    if (block.thread() == 0)
      counts.of_block[block.number()] = static_cast<unsigned long long>(counts.turn) << 32 | n;
    block.wait();

    // Blocks begin in the order of their numbers, so that those before this one are at work or done.
    unsigned ahead = 0;
    for (unsigned b = block.thread(); b < block.number(); b += kGatherBlock) {
      unsigned long long counted = 0;
      do counted = counts.of_block[b];
      while (counted >> 32 != counts.turn);
      ahead += static_cast<unsigned>(counted);
    }
    ahead = sums.sum(ahead);
    if (block.thread() == 0) before = ahead;
    if (block.number() == block.n_blocks() - 1 && block.warp() == 0) {
      const bool was_short = list.length && list.empty();
      if (block.thread() == 0) *total = was_short ? kNoRoom : ahead + n;
    }
    block.wait();

    int *next = to + before;
    for (unsigned first = begin; first < end; first += kGatherBlock) {
      const unsigned w = first + block.thread(), word = w < end ? words[w] : 0;
      unsigned at, all;
      sums.scan(count_bits(word), at, all);
      block.wait();
      for (unsigned left = word; left != 0; left &= left - 1)
        next[at++] = static_cast<int>(w * 32 + lowest_bit(left));
      next += all;
    }
  }
};

}    // namespace lsdcd
