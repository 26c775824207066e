// Threads of a GPU that share their work, so that one with little helps one with much; on a CPU a
// single thread.
#pragma once

#include "base/bits.h"
#include "base/vec3.h"

namespace lsdcd {

// kSize: 1, or 32 for all threads of a warp. All of them must call its functions together.
template <unsigned kSize_>
struct LaneGroup {
  static constexpr unsigned kSize = kSize_;
  static_assert(kSize == 1 || kSize == 32, "a thread or a warp");
  static constexpr unsigned kAll = kSize == 32 ? ~0u : 1u;

  LSDCD_FN static unsigned rank()
  {
#if defined(__CUDA_ARCH__)
    if constexpr (kSize > 1) return threadIdx.x % kSize;
#endif
    return 0;
  }
  // A bit for each thread that says yes.
  LSDCD_FN static unsigned vote(bool yes)
  {
#if defined(__CUDA_ARCH__)
    if constexpr (kSize > 1) return __ballot_sync(kAll, yes);
#endif
    return yes;
  }
  // What the thread of this rank has.
  template <class T>
  LSDCD_FN static T of(T value, [[maybe_unused]] unsigned rank)
  {
#if defined(__CUDA_ARCH__)
    if constexpr (kSize > 1) return __shfl_sync(kAll, value, rank);
#endif
    return value;
  }
  LSDCD_FN static Vec3 of(const Vec3 &v, unsigned rank)
  {
    return {of(v.x, rank), of(v.y, rank), of(v.z, rank)};
  }
  LSDCD_FN static unsigned count(unsigned votes)
  {
    if constexpr (kSize > 1) return static_cast<unsigned>(count_bits(votes));
    return votes;
  }
  // Rank of the first of some votes; 0 where there are none.
  LSDCD_FN static unsigned first([[maybe_unused]] unsigned votes)
  {
    if constexpr (kSize > 1) return votes ? lowest_bit(votes) : 0;
    return 0;
  }
  // Of vote number n, counted from 0.
  LSDCD_FN static unsigned nth(unsigned votes, unsigned n)
  {
    unsigned at = 0;
    for (unsigned half = kSize / 2; half > 0; half /= 2) {
      const unsigned below = count(votes >> at & ((1u << half) - 1));
      if (n < below) continue;
      n -= below;
      at += half;
    }
    return at;
  }
};

// How the threads of a group are dealt out among those that have work: as many to each.
template <class Group>
struct Shares {
  unsigned size = 1;    // of a share
  unsigned owner;       // the thread that this one works for
  unsigned turn;        // its number among those that do
  bool helps;           // is there work for it?
  unsigned own;         // a bit for each thread that works for this one

  // `busy`: a bit for each thread that has work; not 0.
  LSDCD_FN Shares(const Group &group, unsigned busy)
  {
    const unsigned n = group.count(busy), rank = group.rank(), bit = 1u << rank;
    while (2 * size * n <= group.kSize) size *= 2;
    helps = rank / size < n;
    owner = helps ? group.nth(busy, rank / size) : 0;
    turn = rank % size;
    const unsigned before = group.count(busy & (bit - 1));
    own = busy & bit ? (group.kAll >> (group.kSize - size)) << before * size : 0;
  }
};

// Calls f(mine, value), all threads together, for each value that any of them has; `mine`: has this one?
template <class Group, class F>
LSDCD_FN void by_value(const Group &group, bool mine, int value, const F &f)
{
  for (unsigned left = group.vote(mine); left != 0; left = group.vote(mine)) {
    const int next = group.of(value, group.first(left));
    const bool now = mine && value == next;
    f(now, next);
    mine = mine && !now;
  }
}

}    // namespace lsdcd
