// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a query computes for each sphere, and where its answers go.
#pragma once

#include "backend/atomic.h"
#include "backend/warp.h"
#include "grid/lookup/brick_filter.h"
#include "query/nearest_distance.h"
#include "query/sphere.h"

namespace lsdcd {

// Arrays of one query. Those that are null are not wanted. Distances found in float are kept in
// float. They are infinite if no wall is within the radius.
struct AnswerArrays {
  std::uint8_t *status;
  Real *distance;
  float *float_distance;
  std::uint32_t *read;

  static constexpr Real kFar = HUGE_VAL;
  static constexpr float kFloatFar = HUGE_VALF;

  LSDCD_FN void keep(std::size_t i, const Answer &a) const
  {
    status[i] = status_of(a);
    if (distance) distance[i] = a.found() ? a.distance : kFar;
    if (float_distance) float_distance[i] = a.found() ? static_cast<float>(a.distance) : kFloatFar;
    if (read) read[i] = a.read;
  }
  // The same for four neighbours from i on, a multiple of 4, that are far from the wall.
  LSDCD_FN void keep_four_far(std::size_t i) const
  {
    const std::uint8_t s = kCertified;
    four_at(status, i) = {{s, s, s, s}};
    if (distance) four_at(distance, i) = {{kFar, kFar, kFar, kFar}};
    const float f = kFloatFar;
    if (float_distance) four_at(float_distance, i) = {{f, f, f, f}};
    if (read) four_at(read, i) = {{0, 0, 0, 0}};
  }
  // For the spheres from the n-th on, a multiple of 4.
  AnswerArrays after(std::size_t n) const
  {
    return {status + n, distance ? distance + n : nullptr,
            float_distance ? float_distance + n : nullptr, read ? read + n : nullptr};
  }
  LSDCD_FN Real distance_of(std::size_t i) const
  {
    return float_distance ? static_cast<Real>(float_distance[i]) : distance[i];
  }

 private:
  // Aligned so that a GPU stores them at once, or in two parts of 16 bytes.
  template <class T>
  struct alignas(sizeof(T) < 4 ? 4 : 16) Four {
    T v[4];
  };
  template <class T>
  LSDCD_FN static Four<T> &four_at(T *kept, std::size_t i)
  {
    return *reinterpret_cast<Four<T> *>(kept + i);
  }
};

// The first sphere with a radius above the grid's cutoff, below 0, or not a number.
// Radii are compared in the type of the spheres: for float the cutoff is rounded
// to float.
template <class S>
struct TooLarge {
  decltype(S::r) cutoff;
  std::uint64_t *first;    // ~ of its index, the largest of all; 0: none

  LSDCD_FN bool is(const S &s) const { return !(s.r >= 0 && s.r <= cutoff); }
  LSDCD_FN void note(std::size_t i, const S &s) const
  {
    if (is(s)) raise_to(first, ~static_cast<std::uint64_t>(i));
  }
};

// The work for each sphere, for the loops that run a query: an answer at once; or in turn whether it
// may be in a brick, its cell, and an answer from the list of that cell. Without a cell the answer is
// that of a sphere far from the wall. kComplete: grid.nearest is 0.
template <class Distances, class S, bool kComplete>
struct GridWork {
  using Item = S;
  using Filter = BrickFilter<decltype(S::x)>;

  GridView grid;
  BrickTable table;
  const S *spheres;
  AnswerArrays out;
  Filter filter;
  CoarseTable coarse;
  TooLarge<S> too_large;
  std::size_t from;    // spheres before these

  // The same for the spheres from the n-th on, a multiple of 4.
  GridWork after(std::size_t n) const
  {
    return {grid, table, spheres + n, out.after(n), filter, coarse, too_large, from + n};
  }

  LSDCD_FN S sphere(std::size_t i) const { return spheres[i]; }
  LSDCD_FN void check(std::size_t i, const S &s) const { too_large.note(from + i, s); }
  LSDCD_FN void answer(std::size_t i, const S &s) const
  {
    check(i, s);
    out.keep(i, nearest_distance<kComplete, Distances>(grid, s.centre(), s.r));
  }

  // A sphere that is too large passes this test, so that the next test checks it.
  LSDCD_FN BrickGuess guess(const S &s) const
  {
    BrickGuess at = filter.guess({s.x, s.y, s.z});
    at.unsure |= too_large.is(s);
    return at;
  }
  // kNoCell where there are no candidates.
  LSDCD_FN std::uint32_t cell(const S &s) const { return occupied_cell(grid, table, s.centre()); }
  LSDCD_FN const Cell *list(std::uint32_t cell) const { return grid.lists.cells + cell; }
  LSDCD_FN void far(std::size_t i) const { out.keep(i, far_answer()); }
  LSDCD_FN void far(std::size_t i, const S &) const { far(i); }
  LSDCD_FN void four_far(std::size_t i) const { out.keep_four_far(i); }
  LSDCD_FN void answer(std::size_t i, const S &s, const Cell &cell) const
  {
    const Vec3 q = s.centre();
    out.keep(i, nearest_from<kComplete, Distances>(grid, q, s.r, address_inside(grid, q), cell));
  }

  // Is a list too long for one thread, as at a vertex of very many facets?
  static constexpr bool kTogether = kComplete && Distances::kBounded;
  static constexpr std::uint32_t kLongForOne = 32;
  LSDCD_FN bool is_long(const Cell &cell) const { return kTogether && cell.count > kLongForOne; }
  template <unsigned kSize>
  LSDCD_FN void answer_together(std::size_t i, const S &s, const Cell &cell,
                                const Warp<kSize> &warp) const
  {
    if constexpr (kTogether) {
      const Vec3 q = s.centre();
      const Answer a =
          nearest_together<Distances>(grid, q, s.r, address_inside(grid, q), cell, warp);
      if (warp.rank() == 0) out.keep(i, a);
    }
  }
};

}    // namespace lsdcd
