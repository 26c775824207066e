// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The brick table in the shared memory of a GPU's block, for kernels that look up every sphere.
#pragma once

#include "backend/block.h"
#include "grid/lookup/brick_words.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// There a warp's requests for 32 words take three or four cycles; through a cache each takes one.
class SharedBrickTable {
 public:
  // Bytes that it takes, a multiple of 4; 0: there are too many bricks.
  static std::size_t bytes(const BrickTable &table)
  {
    if (table.n_bricks > 1u << 16) return 0;
    return table.n_words * sizeof(std::uint32_t) +
           (table.n_words + 1) / 2 * 2 * sizeof(std::uint16_t);
  }

  // Copies the table to `to`. All threads of a block call this, and wait for each other.
  LSDCD_GPU_FN SharedBrickTable(const BrickTable &table, void *to) :
      bits_(static_cast<std::uint32_t *>(to)),
      below_(reinterpret_cast<std::uint16_t *>(bits_ + table.n_words))
  {
    // Several are loaded before the first is stored.
    constexpr unsigned kAtOnce = 8;
    for (unsigned first = Block::thread(); first < table.n_words;
         first += kAtOnce * Block::n_threads()) {
      BrickWord word[kAtOnce];
#pragma unroll
      for (unsigned k = 0; k < kAtOnce; k++) {
        const unsigned w = first + k * Block::n_threads();
        word[k] = table.words[w < table.n_words ? w : first];
      }
#pragma unroll
      for (unsigned k = 0; k < kAtOnce; k++) {
        const unsigned w = first + k * Block::n_threads();
        if (w >= table.n_words) continue;
        bits_[w] = word[k].bits;
        below_[w] = static_cast<std::uint16_t>(word[k].below);
      }
    }
    Block::wait();
  }

  LSDCD_GPU_FN bool at(std::uint32_t slot) const
  {
    return bits_[slot / 32] >> slot % 32 & 1u;
  }
  LSDCD_GPU_FN BrickWord word(std::uint32_t slot) const
  {
    return {bits_[slot / 32], below_[slot / 32]};
  }

 private:
  std::uint32_t *bits_;
  std::uint16_t *below_;
};

}    // namespace lsdcd
