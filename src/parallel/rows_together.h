// Rows of a warp's spheres, read and added to by all of its lanes together. Three-vectors
// of doubles lie 24 bytes apart: a lane that takes its own row asks for three words, each a
// request of its own that no neighbour shares. Here neighbours take neighbouring words, and
// hand them to the lane whose sphere they are of.
#pragma once

#include "base/rows.h"

#include <cstring>

namespace lsdcd {

// The rows of one sphere, by itself.
class RowsAlone {
 public:
  static constexpr bool kOneOfMany = false;

  LSDCD_FN explicit RowsAlone(std::size_t i) : i_(i) {}

  LSDCD_FN Vec3 read(const Rows<const Real> &rows) const { return rows[i_]; }
  // Adds a to row i of `to_a` and b to that of `to_b`, if `mine`.
  LSDCD_FN void add(const Rows<Real> &to_a, const Vec3 &a, const Rows<Real> &to_b, const Vec3 &b,
                    bool mine) const
  {
    if (!mine) return;
    // All are read before one is written: the compiler does not know that they are apart.
    const Vec3 sum_a = to_a[i_] + a, sum_b = to_b[i_] + b;
    to_a.put(i_, sum_a);
    to_b.put(i_, sum_b);
  }

 private:
  std::size_t i_;
};

// Who has which of the 96 words of 32 rows: word w is component w % 3 of row w / 3, and is
// the (w / 32)-th word of lane w % 32. As 3 and 32 have no common factor, for one component
// every lane has just one word to give.
struct WarpWords {
  static constexpr int kLanes = 32;

  LSDCD_FN static int row(int lane, int r) { return (lane + kLanes * r) / 3; }
  LSDCD_FN static int component(int lane, int r) { return (lane + kLanes * r) % 3; }
  // The lane that has component c of row `row`.
  LSDCD_FN static int lane_with(int row, int c) { return (3 * row + c) % kLanes; }
  // The row whose component c a lane has (11 is the inverse of 3), and which of its words
  // that is.
  LSDCD_FN static int row_given(int lane, int c) { return (11 * (lane + kLanes - c)) % kLanes; }
  LSDCD_FN static int word_given(int lane, int c) { return (3 * row_given(lane, c) + c) / kLanes; }
};

constexpr int kMostTogether = 128;    // threads of a block that store together

// Stores the `value` of each lane that is `mine` in its place. Places of neighbours are
// neighbours, the first lane is `mine`, and so are all before one that is. Every lane must take
// part.
template <class T>
LSDCD_FN void store_together(T *place, const T &value, bool mine)
{
#if defined(__CUDA_ARCH__)
  using Word = unsigned long long;
  constexpr int kWords = sizeof(T) / sizeof(Word);
  static_assert(sizeof(T) % sizeof(Word) == 0 && alignof(T) == sizeof(Word), "whole words");
  __shared__ Word of_block[kMostTogether * kWords];
  const int lane = threadIdx.x % WarpWords::kLanes;
  Word *words = of_block + (threadIdx.x - lane) * kWords;
  memcpy(words + lane * kWords, &value, sizeof value);
  const int n = __popc(__ballot_sync(~0u, mine)) * kWords;
  const Word first = __shfl_sync(~0u, reinterpret_cast<Word>(place), 0);
  __syncwarp();
  Word *to = reinterpret_cast<Word *>(first);
#pragma unroll
  for (int r = 0; r < kWords; r++) {
    const int w = lane + WarpWords::kLanes * r;
    if (w < n) to[w] = words[w];
  }
  __syncwarp();
#else
  if (mine) *place = value;
#endif
}

// The rows of the spheres of a warp's lanes; every lane must take part in every call. Where
// there are no warps, and where rows are not packed, each lane takes its own.
class RowsTogether {
 public:
  static constexpr bool kOneOfMany = true;

  // The first of the calls, of for_each(n, f) with n a multiple of kTogether, that run
  // together with call `at`.
  static constexpr std::size_t kTogether = WarpWords::kLanes;
  LSDCD_FN static std::size_t first(std::size_t at)
  {
#if defined(__CUDA_ARCH__)
    return at / kTogether * kTogether;
#else
    return at;
#endif
  }

  LSDCD_FN explicit RowsTogether(int i) : own_(i)
  {
#if defined(__CUDA_ARCH__)
    lane_ = threadIdx.x % WarpWords::kLanes;
#pragma unroll
    for (int r = 0; r < 3; r++) row_[r] = __shfl_sync(~0u, i, WarpWords::row(lane_, r));
#endif
  }

  LSDCD_FN Vec3 read(const Rows<const Real> &rows) const
  {
#if defined(__CUDA_ARCH__)
    if (packed(rows)) {
      Real word[3];
#pragma unroll
      for (int r = 0; r < 3; r++) word[r] = *at(rows, r);
      return {handed<0>(word), handed<1>(word), handed<2>(word)};
    }
#endif
    return RowsAlone(own_).read(rows);
  }

  LSDCD_FN void add(const Rows<Real> &to_a, const Vec3 &a, const Rows<Real> &to_b, const Vec3 &b,
                    bool mine) const
  {
#if defined(__CUDA_ARCH__)
    if (packed(to_a) && packed(to_b)) {
      const unsigned asked = __ballot_sync(~0u, mine);
      Real word_a[3], word_b[3];
      bool wanted[3];
#pragma unroll
      for (int r = 0; r < 3; r++) {
        wanted[r] = (asked >> WarpWords::row(lane_, r)) & 1u;
        word_a[r] = wanted[r] ? *at(to_a, r) : 0;
        word_b[r] = wanted[r] ? *at(to_b, r) : 0;
      }
      add_handed<0>(a.x, b.x, word_a, word_b);
      add_handed<1>(a.y, b.y, word_a, word_b);
      add_handed<2>(a.z, b.z, word_a, word_b);
#pragma unroll
      for (int r = 0; r < 3; r++) {
        if (!wanted[r]) continue;
        *at(to_a, r) = word_a[r];
        *at(to_b, r) = word_b[r];
      }
      return;
    }
#endif
    RowsAlone(own_).add(to_a, a, to_b, b, mine);
  }

 private:
#if defined(__CUDA_ARCH__)
  template <class T>
  __device__ static bool packed(const Rows<T> &rows)
  {
    return rows.row == 3 && rows.column == 1;
  }
  template <class T>
  __device__ T *at(const Rows<T> &rows, int r) const
  {
    return rows.at + (std::ptrdiff_t(row_[r]) * 3 + WarpWords::component(lane_, r));
  }
  // Component c of this lane's row, from the lane that has it.
  template <int c>
  __device__ Real handed(const Real (&word)[3]) const
  {
    const int give = WarpWords::word_given(lane_, c);
    return __shfl_sync(~0u, give == 0 ? word[0] : (give == 1 ? word[1] : word[2]),
                       WarpWords::lane_with(lane_, c));
  }
  // Adds component c of all lanes' rows to the words.
  template <int c>
  __device__ void add_handed(Real a, Real b, Real (&word_a)[3], Real (&word_b)[3]) const
  {
    const int from = WarpWords::row_given(lane_, c), to = WarpWords::word_given(lane_, c);
    const Real more_a = __shfl_sync(~0u, a, from), more_b = __shfl_sync(~0u, b, from);
#pragma unroll
    for (int r = 0; r < 3; r++) {
      word_a[r] = r == to ? word_a[r] + more_a : word_a[r];
      word_b[r] = r == to ? word_b[r] + more_b : word_b[r];
    }
  }
#endif
  int own_, lane_ = 0;
  int row_[3] = {};    // of this lane's words
};

}    // namespace lsdcd
