// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The second part of the broad phase on a GPU: the exact test of spheres that the test by cells leaves.
#pragma once

#include "backend/atomic.h"
#include "backend/block.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// The spheres that the test by cells leaves, with the cell of each. Their order does not matter, as each
// becomes a bit. There are several lists, since warps that add to one length wait for each other.
struct CandidateLists {
  static constexpr unsigned kLists = 32, kStride = 32;    // lengths are 128 bytes apart
  struct Item {
    unsigned sphere;
    std::uint32_t cell;    // as CandidateTest::locate() returns it
  };

  Item *items = nullptr;         // null: there is no second part
  unsigned *length = nullptr;    // of each list; may be more than its room
  unsigned room = 0;             // of a list

  // Adds an item for each thread of a warp that has one.
  LSDCD_GPU_FN void put(bool has_one, const Item &item) const
  {
    const GpuWarp warp;
    const unsigned votes = warp.vote(has_one), list = Block::number() % kLists;
    if (votes == 0) return;
    const unsigned at =
        warp.take_room(length + list * kStride, warp.count(votes)) + warp.count_below(votes);
    if (has_one && at < room) items[list * room + at] = item;
  }
  // Has entry k an item? Entries are counted over the room of all lists.
  LSDCD_GPU_FN bool has(unsigned k) const
  {
    return k < kLists * room && k % room < length[k / room * kStride];
  }
  // Empties the lists, by all threads of a warp, and sets *longest() to the length of the longest one.
  // Returns whether a list had too little room.
  static constexpr unsigned kLengths = kLists * kStride + 1;
  LSDCD_FN unsigned *longest() const { return length + kLists * kStride; }
  LSDCD_GPU_FN bool empty() const
  {
    static_assert(kLists == kWarpSize, "one for each thread");
    const GpuWarp warp;
    unsigned &mine = length[warp.rank() * kStride];
    const unsigned most = warp.largest(mine);
    mine = 0;
    if (warp.rank() == 0) *longest() = most;
    return most > room;
  }
};

// Sets the bits in `words` of the spheres that pass the tests of `work`.
template <class Work>
struct Refine {
  Work work;
  CandidateLists list;
  unsigned *words;

  template <unsigned kSize>
  LSDCD_GPU_FN void operator()(const Warp<kSize> &warp, bool, std::size_t number) const
  {
    const unsigned k = static_cast<unsigned>(number);
    const bool mine = list.has(k);
    if (!warp.vote(mine)) return;
    const CandidateLists::Item item = mine ? list.items[k] : CandidateLists::Item();
    const bool passes = work.refine(warp, mine, item.sphere, item.cell);
    if (!mine) return;
    if (passes)
      set_bits(words + item.sphere / 32, 1u << item.sphere % 32);
    else if (work.has_notes())
      work.note(item.sphere, false);
  }
};

}    // namespace lsdcd
