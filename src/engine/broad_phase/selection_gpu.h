// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects the candidate spheres on a GPU.
#pragma once

#include "backend/backend.h"
#include "engine/broad_phase/gather_marked_gpu.h"
#include "engine/broad_phase/mark_candidates_gpu.h"
#include "engine/broad_phase/selection.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

template <class B>
class Selection<B, false> {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  template <class Work>
  void start(B &b, std::size_t n, const Work &work, int *to, std::uint32_t *total)
  {
    const unsigned n_tiles = static_cast<unsigned>((n + kMarkTile - 1) / kMarkTile),
                   n_words = n_tiles * kMarkWords, processors = limits_.processors();
    if (words_.size() < n_words) words_ = Array<unsigned>(n_words + n_words / 8);
    if (counts_.size() == 0) counts_ = zeros<unsigned long long>(b, processors + 1);
    CandidateLists list;
    if (work.has_refine()) {
      if (length_.size() == 0) {
        length_ = zeros<unsigned>(b, CandidateLists::kLengths);
        reserve(kFirstRoom);
      }
      list = lists();
    }
    unsigned *words = words_.data();
    if (n > 0) mark(b, static_cast<unsigned>(n), work, words, list);
    if (list.items)
      b.for_each_in_warps(CandidateLists::kLists * std::size_t(list.room),
                          Refine<Work>{work, list, words});
    const unsigned each =
        std::max((n_words + processors - 1) / processors, kGatherBlock);    // words of a block
    b.for_each_block(
        {n_words / each + 1, kGatherBlock},
        GatherMarked{words, n_words, each, {counts_.data(), ++turn_}, list, to, total});
  }

  bool had_room(B &b, std::uint32_t total)
  {
    if (total != kNoRoom) return true;
    const unsigned longest = read_one(b, lists().longest());
    reserve(longest + longest / 8);
    return false;
  }

  std::size_t bytes() const
  {
    return words_.size() * sizeof(unsigned) + items_.size() * sizeof(CandidateLists::Item);
  }

 private:
  static constexpr unsigned kFirstRoom = 128;    // of a list

  template <class Work>
  void mark(B &b, unsigned n, const Work &work, unsigned *words, const CandidateLists &list)
  {
    const auto shape = limits_.shape(kMarkWarps, kMarkBlocks, sizeof(MarkTile),
                                     SharedBrickTable::bytes(work.table));
    const unsigned of_block = kMarkTile * shape.warps;
    const unsigned blocks =
        std::min((n + of_block - 1) / of_block, limits_.processors() * kMarkBlocks);
    const LaunchShape launch = {blocks, kWarpSize * shape.warps, shape.shared};
    if (shape.has_table)
      b.for_each_block(launch, MarkCandidates<true, Work>{n, work, words, list});
    else
      b.for_each_block(launch, MarkCandidates<false, Work>{n, work, words, list});
  }

  CandidateLists lists()
  {
    return {items_.data(), length_.data(),
            static_cast<unsigned>(items_.size() / CandidateLists::kLists)};
  }
  void reserve(unsigned of_list)
  {
    const std::size_t each = (std::size_t(of_list) + kWarpSize - 1) / kWarpSize * kWarpSize;
    items_ = Array<CandidateLists::Item>(CandidateLists::kLists * each);
  }
  template <class T>
  static Array<T> zeros(B &b, std::size_t n)
  {
    return from_host(b, std::vector<T>(n, 0));
  }

  Array<unsigned> words_;    // a bit for each sphere
  Array<CandidateLists::Item> items_;
  Array<unsigned> length_;
  Array<unsigned long long> counts_;
  unsigned turn_ = 0;
  typename B::Limits limits_;
};

}    // namespace lsdcd
