// The second look of a choice on an NVIDIA GPU, at the items that the first one, a mark, leaves.
#pragma once

#include "backend/cuda_warp.h"

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
    const unsigned votes = __ballot_sync(kAllLanes, has_one), list = blockIdx.x % kLists;
    if (votes == 0) return;
    const unsigned at = room_at(length + list * kStride, __popc(votes)) + votes_below(votes);
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
    static_assert(kLists == 32, "one for each lane");
    unsigned most = length[threadIdx.x % 32 * kStride];
    length[threadIdx.x % 32 * kStride] = 0;
    for (unsigned d = 16; d > 0; d /= 2) most = max(most, __shfl_xor_sync(kAllLanes, most, d));
    if (threadIdx.x % 32 == 0) *longest() = most;
    return most > room;
  }
};

// Sets the bits in `words` of the items that `work` keeps.
template <class Work>
struct SecondLook {
  Work work;
  SecondLookList list;
  unsigned *words;

  template <class Group>
  __device__ void operator()(const Group &group, bool, std::size_t number) const
  {
    const unsigned k = static_cast<unsigned>(number);
    const bool mine = list.has(k);
    if (!group.vote(mine)) return;
    const SecondLookList::Item item = mine ? list.items[k] : SecondLookList::Item();
    const bool kept = work.keep_after_all(group, mine, item.index, item.found);
    if (!mine) return;
    if (kept)
      atomicOr(words + item.index / 32, 1u << item.index % 32);
    else if (work.notes())
      work.note(item.index, false);
  }
};

}    // namespace lsdcd
