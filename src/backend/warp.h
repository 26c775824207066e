// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Threads of a GPU's warp that share their work, so that one with little helps one with much; on a CPU a
// single thread.
#pragma once

#include "backend/bits.h"
#include "base/vec3.h"

#include <cstddef>
#include <cstdint>

namespace lsdcd {

constexpr unsigned kWarpSize = 32;
// Threads of a block of a GPU that for_each_in_warps() starts.
constexpr unsigned kInWarpsBlock = 128;

// kSize: 1, kWarpSize for all threads of a warp, or a power of two for so many neighbours, beside which others
// may do something else. All kSize threads must call its functions together.
template <unsigned kSize_>
struct Warp {
  static constexpr unsigned kSize = kSize_;
  static_assert(kSize > 0 && kWarpSize % kSize == 0, "whole parts of a warp");
  static constexpr unsigned kAll = kSize == kWarpSize ? ~0u : (1u << kSize % kWarpSize) - 1;

  LSDCD_FN static unsigned rank()
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return threadIdx.x % kSize;
#endif
    return 0;
  }
  // Until all threads are here, and see what each has written.
  LSDCD_FN static void wait()
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) __syncwarp(members());
#endif
  }
  // Returns a bit for each thread that says yes.
  LSDCD_FN static unsigned vote(bool yes)
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return __ballot_sync(members(), yes) >> shift() & kAll;
#endif
    return yes;
  }
  LSDCD_FN static bool any(bool yes)
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return __any_sync(members(), yes);
#endif
    return yes;
  }
  // Returns the value that the thread of this rank has.
  template <class T>
  LSDCD_FN static T of(T value, [[maybe_unused]] unsigned rank)
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return __shfl_sync(members(), value, rank, kSize);
#endif
    return value;
  }
  LSDCD_FN static Vec3 of(const Vec3 &v, unsigned rank)
  {
    return {of(v.x, rank), of(v.y, rank), of(v.z, rank)};
  }
  // Returns the value that the thread `step` ranks below has; its own where there is none.
  template <class T>
  LSDCD_FN static T from_below(T value, [[maybe_unused]] unsigned step)
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return __shfl_up_sync(members(), value, step, kSize);
#endif
    return value;
  }
  // Returns the largest value that any thread has.
  LSDCD_FN static unsigned largest(unsigned value)
  {
#if LSDCD_ON_GPU()
    for (unsigned apart = 1; apart < kSize; apart *= 2)
      value = max(value, __shfl_xor_sync(members(), value, apart));
#endif
    return value;
  }
  LSDCD_FN static std::uint64_t largest(std::uint64_t value)
  {
    for (unsigned apart = 1; apart < kSize; apart *= 2) {
      const std::uint64_t other = of_other(value, apart);
      if (other > value) value = other;
    }
    return value;
  }
  // Returns the value of the thread whose rank differs in the bit `apart`; its own where there is none.
  template <class T>
  LSDCD_FN static T of_other(T value, [[maybe_unused]] unsigned apart)
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) return __shfl_xor_sync(members(), value, apart);
#endif
    return value;
  }
  template <class T>
  LSDCD_FN static T least(T value)
  {
    for (unsigned apart = 1; apart < kSize; apart *= 2) value = fmin(value, of_other(value, apart));
    return value;
  }
  // Returns the sum of the values of all threads, in an order that is always the same.
  template <class T>
  LSDCD_FN static T sum(T value)
  {
    for (unsigned apart = 1; apart < kSize; apart *= 2) value += of_other(value, apart);
    return value;
  }
  // Returns the sum of the values of this thread and of those with lower ranks.
  LSDCD_FN static unsigned sum_up(unsigned value)
  {
    for (unsigned apart = 1; apart < kSize; apart *= 2) {
      const unsigned below = from_below(value, apart);
      if (rank() >= apart) value += below;
    }
    return value;
  }

  // Adds up the values of threads side by side that have the same key, each value for itself. Returns whether this thread is the
  // first one of its key, which has the sums.
  template <class... T>
  LSDCD_FN static bool sum_side_by_side([[maybe_unused]] unsigned key,
                                        [[maybe_unused]] T &...values)
  {
    if constexpr (kSize == 1) return true;
    for (unsigned step = 1; step < kSize; step *= 2) {
      const unsigned next = (rank() + step) % kSize;
      const bool adds = of(key, next) == key && rank() + step < kSize;
      if (!any(adds)) break;
      (add_if(adds, values, of(values, next)), ...);
    }
    const unsigned below = from_below(key, 1);
    return rank() == 0 || below != key;
  }

  // Adds up the numbers of the threads that have the same key, of those that say `mine`. Returns whether this thread has
  // the sums of its key. On a GPU of a whole warp.
  template <int n>
  LSDCD_FN static bool sum_by_key(bool mine, [[maybe_unused]] int key,
                                  [[maybe_unused]] std::int64_t (&sums)[n])
  {
#if LSDCD_ON_GPU()
    if constexpr (kSize > 1) {
      static_assert(kSize == kWarpSize, "a whole warp");
      // In each round every second thread of a key that is left adds what the next one has, which then is done.
      const unsigned same = __match_any_sync(kAll, mine ? key : -1), rank = threadIdx.x % kSize;
      unsigned place = count_bits(same & ((1u << rank) - 1)), above = same & (~1u << rank);
      const bool is_first = place == 0;
      while (__any_sync(kAll, above != 0)) {
        const bool has = above != 0;
        const unsigned next = has ? lowest_bit(above) : rank;
        for (int k = 0; k < n; k++) {
          const std::int64_t other = __shfl_sync(kAll, sums[k], next);
          if (has) sums[k] += other;
        }
        const bool is_done = place & 1;
        const unsigned left = __ballot_sync(kAll, !is_done);
        above = is_done ? 0 : above & left;
        place /= 2;
      }
      return mine && is_first;
    }
#endif
    return mine;
  }

  LSDCD_FN static unsigned count(unsigned votes)
  {
    if constexpr (kSize > 1) return static_cast<unsigned>(count_bits(votes));
    return votes;
  }
  // Returns the number of votes of threads with lower ranks than this one's.
  LSDCD_FN static unsigned count_below(unsigned votes)
  {
    return count(votes & ((1u << rank()) - 1));
  }
  // Rank of the first of some votes; 0 where there are none.
  LSDCD_FN static unsigned first([[maybe_unused]] unsigned votes)
  {
    if constexpr (kSize > 1) return votes ? lowest_bit(votes) : 0;
    return 0;
  }
  // Rank of vote number n, counted from 0.
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
  // Adds to a value where a thread says so.
  template <class T>
  LSDCD_FN static void add_if(bool adds, T &value, const T &other)
  {
    if (adds) value += other;
  }
#if defined(__CUDACC__)
  // Takes room for n things of the warp at `end`, which many warps share; returns where it begins.
  template <class T>
  __device__ static T take_room(T *end, unsigned n)
  {
    T at = 0;
    if (rank() == 0 && n > 0) at = atomicAdd(end, static_cast<T>(n));
    return of(at, 0);
  }

 private:
  // In the hardware's warp: the rank of the first thread, and a bit for each.
  __device__ static unsigned shift()
  {
    return kSize == kWarpSize ? 0 : threadIdx.x % kWarpSize / kSize * kSize;
  }
  __device__ static unsigned members()
  {
    return kAll << shift();
  }
#endif
};

// How a warp's threads are dealt out among those that have work: to each as many.
template <unsigned kSize>
struct WorkSplit {
  unsigned size = 1;    // threads for each that has work
  unsigned owner;       // the thread that this one works for
  unsigned turn;        // its number among those that do
  bool helps;           // is there work for it?
  unsigned own;         // a bit for each thread that works for this one

  // `busy`: a bit for each thread that has work; not 0.
  LSDCD_FN WorkSplit(const Warp<kSize> &warp, unsigned busy)
  {
    const unsigned n = warp.count(busy), rank = warp.rank(), bit = 1u << rank;
    while (2 * size * n <= kSize) size *= 2;
    helps = rank / size < n;
    owner = helps ? warp.nth(busy, rank / size) : 0;
    turn = rank % size;
    const unsigned before = warp.count(busy & (bit - 1));
    own = busy & bit ? (warp.kAll >> (kSize - size)) << before * size : 0;
  }
};

// A row that each thread of a warp makes for its place in memory, behind that of the thread before. On a CPU it is made in
// that place.
template <unsigned kSize, class Row>
class RowOf {
 public:
  static_assert(kSize == 1, "on a CPU");
  // `to`: the place.
  LSDCD_FN explicit RowOf(Row *to) : to_(to) {}
  LSDCD_FN Row &operator*() { return *to_; }
  // Writes the words of the row that have a bit in `words`, and no others; see words_of().
  LSDCD_FN void put(std::uint32_t /*words*/) {}

 private:
  Row *to_;
};

// Bits of words [begin, end) of a row, by their bytes.
LSDCD_FN std::uint32_t words_of(std::size_t begin, std::size_t end)
{
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  return (std::uint32_t(1) << end / kWord) - (std::uint32_t(1) << begin / kWord);
}

#if defined(__CUDACC__)
// On a GPU it is made beside, and a warp writes whole lines of memory. In for_each_in_warps(), by whole warps; the first
// thread has a row.
template <class Row>
class RowOf<kWarpSize, Row> {
 public:
  LSDCD_FN explicit RowOf(Row *to) : to_(to) {}
  LSDCD_FN Row &operator*() { return row_; }
  LSDCD_FN void put([[maybe_unused]] std::uint32_t words)
  {
#if LSDCD_ON_GPU()
    using Word = unsigned long long;
    constexpr Warp<kWarpSize> warp;
    constexpr unsigned kWords = sizeof(Row) / sizeof(Word),
                       kApart = kWords | 1;    // odd, so that rows lie in different banks
    static_assert(sizeof(Row) % sizeof(Word) == 0 && kWords < 32, "a bit for each word");
    __shared__ Word of_block[kInWarpsBlock * kApart];
    Word *const rows = of_block + threadIdx.x / kWarpSize * kWarpSize * kApart,
                *const to = reinterpret_cast<Word *>(warp.of(reinterpret_cast<Word>(to_), 0));
    Word mine[kWords];
    memcpy(mine, &row_, sizeof row_);
    warp.wait();    // until the rows before these are written
#pragma unroll
    for (unsigned k = 0; k < kWords; k++) rows[warp.rank() * kApart + k] = mine[k];
    warp.wait();
#pragma unroll
    for (unsigned k = 0; k < kWords; k++) {
      const unsigned at = k * kWarpSize + warp.rank(), its = at / kWords, word = at % kWords;
      if (warp.of(words, its) >> word & 1) to[at] = rows[its * kApart + word];
    }
#endif
  }

 private:
  Row *to_;
  Row row_;
};
#endif

// Returns the last thread whose numbers begin at k or before, where those of a thread follow those of the thread before. All threads
// together.
template <unsigned kSize>
LSDCD_FN unsigned owner_of(const Warp<kSize> &warp, std::uint32_t first, std::uint32_t k)
{
  unsigned owner = 0;
  for (unsigned half = kSize / 2; half > 0; half /= 2)
    if (warp.of(first, owner + half) <= k) owner += half;
  return owner;
}

// Calls f(rank, k) for each number k in [first, end) of the thread of this rank. The numbers of a thread follow those of the
// thread before; on a GPU threads that are side by side get numbers that are.
template <unsigned kSize, class F>
LSDCD_FN void for_each_side_by_side(const Warp<kSize> &warp, std::uint32_t first, std::uint32_t end,
                                    const F &f)
{
  const std::uint32_t last = warp.of(end, kSize - 1);
  for (std::uint32_t from = warp.of(first, 0); from < last; from += kSize) {
    const std::uint32_t k = from + warp.rank();
    const unsigned owner = owner_of(warp, first, k);
    if (k < last) f(owner, k);
  }
}

// Calls f(mine, value), all threads together, for each value that any of them has; `mine`: has this one?
template <unsigned kSize, class F>
LSDCD_FN void for_each_distinct(const Warp<kSize> &warp, bool mine, int value, const F &f)
{
  for (unsigned left = warp.vote(mine); left != 0; left = warp.vote(mine)) {
    const int next = warp.of(value, warp.first(left));
    const bool now = mine && value == next;
    f(now, next);
    mine = mine && !now;
  }
}

}    // namespace lsdcd
