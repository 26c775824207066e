// The second look of a choice on an NVIDIA GPU, at the items that the first one, a mark, leaves.
#pragma once

#include "backend/warp.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>

namespace lsdcd {

// Where the first look leaves items, with what it has found of them. Their order does not matter: each
// is a bit in the end. They are in several lists, as all counting in one length would wait for each other.
struct SecondLookList {
  static constexpr unsigned kLists = 32, kStride = 32;    // of lengths: 128 bytes apart
  struct Item {
    unsigned index;
    std::uint32_t found;
  };

  Item *items = nullptr;         // null: there is no second look
  unsigned *length = nullptr;    // of each list, also where that is more than its room
  unsigned room = 0;             // of a list

  // A warp's items, for each lane that has one.
  __device__ void put(bool has_one, const Item &item) const
  {
    const Warp<kWarpSize> warp;
    const unsigned votes = warp.vote(has_one), list = blockIdx.x % kLists;
    if (votes == 0) return;
    const unsigned at =
        warp.take_room(length + list * kStride, warp.count(votes)) + warp.count_below(votes);
    if (has_one && at < room) items[list * room + at] = item;
  }
  // Is there an item number k, counted over the room of all lists?
  __device__ bool has(unsigned k) const
  {
    return k < kLists * room && k % room < length[k / room * kStride];
  }
  // Empties the lists. Was there too little room? All lanes of a warp ask together. *longest(), which
  // is not emptied, becomes the length of the longest list.
  static constexpr unsigned kLengths = kLists * kStride + 1;
  __host__ __device__ unsigned *longest() const { return length + kLists * kStride; }
  __device__ bool empty() const
  {
    static_assert(kLists == kWarpSize, "one for each thread");
    const Warp<kWarpSize> warp;
    unsigned &mine = length[warp.rank() * kStride];
    const unsigned most = warp.largest(mine);
    mine = 0;
    if (warp.rank() == 0) *longest() = most;
    return most > room;
  }
};

// Sets the bits in `words` of the items that `work` keeps.
template <class Work>
struct SecondLook {
  Work work;
  SecondLookList list;
  unsigned *words;

  template <unsigned kSize>
  __device__ void operator()(const Warp<kSize> &warp, bool, std::size_t number) const
  {
    const unsigned k = static_cast<unsigned>(number);
    const bool mine = list.has(k);
    if (!warp.vote(mine)) return;
    const SecondLookList::Item item = mine ? list.items[k] : SecondLookList::Item();
    const bool kept = work.keep_after_all(warp, mine, item.index, item.found);
    if (!mine) return;
    if (kept)
      atomicOr(words + item.index / 32, 1u << item.index % 32);
    else if (work.notes())
      work.note(item.index, false);
  }
};

}    // namespace lsdcd
