// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The work for each sphere of a query that asks only for distances, on a GPU.
#pragma once

#include "backend/atomic.h"
#include "backend/warp.h"
#include "grid/lookup/brick_filter.h"
#include "query/nearest_distance.h"
#include "query/sphere.h"

namespace lsdcd {

// The arrays of a query. If `distance` is null, it is not asked for. Distances are infinite if no wall is within the
// radius.
template <class T>
struct DistanceArrays {
  std::uint8_t *status;
  T *distance;

  static constexpr T kFar = static_cast<T>(HUGE_VAL);

  LSDCD_FN void store(std::size_t i, const Answer &a) const
  {
    status[i] = status_of(a);
    if (distance) distance[i] = a.found() ? static_cast<T>(a.distance) : kFar;
  }
  // Stores the answers of four neighbours from i on, a multiple of 4, that are far from the wall.
  LSDCD_FN void store_four_far(std::size_t i) const
  {
    four_at(status, i) = {{kCertified, kCertified, kCertified, kCertified}};
    if (distance) four_at(distance, i) = {{kFar, kFar, kFar, kFar}};
  }
  // Returns the arrays from the n-th sphere on, a multiple of 4.
  DistanceArrays after(std::size_t n) const
  {
    return {status + n, distance ? distance + n : nullptr};
  }

 private:
  // Four numbers, aligned so that a GPU stores them at once, or in two parts of 16 bytes.
  template <class U>
  struct alignas(sizeof(U) < 4 ? 4 : 16) Four {
    U v[4];
  };
  template <class U>
  LSDCD_FN static Four<U> &four_at(U *array, std::size_t i)
  {
    return *reinterpret_cast<Four<U> *>(array + i);
  }
};

// Finds the first sphere with a radius above the grid's cutoff, below 0, or not a number. Radii are compared in the
// type of the spheres: for float the cutoff is rounded to float.
template <class S>
struct TooLarge {
  decltype(S::r) cutoff;
  std::uint64_t *first;    // ~ of its index, the largest of all; 0: there is none

  LSDCD_FN bool is(const S &s) const { return !(s.r >= 0 && s.r <= cutoff); }
  LSDCD_FN void note(std::size_t i, const S &s) const
  {
    if (is(s)) raise_to(first, ~static_cast<std::uint64_t>(i));
  }
};

// The work for each sphere, which kernels do in this order: find out whether it may be in a brick, find its cell, and
// search the list of that cell. Without a cell the answer is that of a sphere far from the wall.
template <class Search, class S>
struct GridWork {
  using Item = S;
  using Distances = typename Search::Distances;
  using Filter = BrickFilter<decltype(S::x)>;

  GridView grid;
  BrickTable table;
  const S *spheres;
  DistanceArrays<decltype(S::x)> out;
  Filter filter;
  CoarseTable coarse;
  TooLarge<S> too_large;
  std::size_t from;    // number of spheres before these

  // Returns this work from the n-th sphere on, a multiple of 4.
  GridWork after(std::size_t n) const
  {
    return {grid, table, spheres + n, out.after(n), filter, coarse, too_large, from + n};
  }

  LSDCD_FN void check(std::size_t i, const S &s) const { too_large.note(from + i, s); }

  // Guesses the brick. A sphere that is too large passes this test, so that the next test checks it.
  LSDCD_FN BrickGuess guess(const S &s) const
  {
    BrickGuess at = filter.guess({s.x, s.y, s.z});
    at.unsure |= too_large.is(s);
    return at;
  }
  // Returns the cell of the sphere; kNoCell if it has no entries.
  LSDCD_FN std::uint32_t cell(const S &s) const { return occupied_cell(grid, table, s.centre()); }
  LSDCD_FN const Cell *list(std::uint32_t cell) const { return grid.lists.cells + cell; }
  LSDCD_FN void far(std::size_t i) const { out.store(i, far_answer()); }
  LSDCD_FN void four_far(std::size_t i) const { out.store_four_far(i); }
  LSDCD_FN void search_list(std::size_t i, const S &s, const Cell &cell) const
  {
    const Vec3 q = s.centre();
    out.store(i, nearest_from<Search>(grid, q, s.r, address_inside(grid, q), cell));
  }

  // Whether a list can be too long for one thread, as at a vertex of very many facets.
  static constexpr bool kHasLong = Search::kComplete;
  static constexpr std::uint32_t kLongForOne = 32;
  LSDCD_FN bool is_long(const Cell &cell) const { return kHasLong && cell.count > kLongForOne; }
  template <unsigned kSize>
  LSDCD_FN void search_in_warp(std::size_t i, const S &s, const Cell &cell,
                               const Warp<kSize> &warp) const
  {
    if constexpr (kHasLong) {
      const Vec3 q = s.centre();
      const Answer a =
          nearest_in_warp<Distances>(grid, q, s.r, address_inside(grid, q), cell, warp);
      if (warp.rank() == 0) out.store(i, a);
    }
  }
};

}    // namespace lsdcd
