// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The distance from one sphere to the wall, and whether it is certified.
#pragma once

#include "query/distances.h"

#include <cstdint>

namespace lsdcd {

struct Answer {
  Real distance;         // from the centre to the wall; kAnyDistance: not within the radius
  bool certified;        // nothing that the list leaves out can be nearer, or touch
  std::uint32_t read;    // entries of lists
  // The code in the list of what is nearest, and whether that is a primitive; not set by
  // nearest_together().
  FeatureCode feature = kNoFeature;
  bool primitive = false;

  LSDCD_FN bool found() const { return distance < kAnyDistance; }
};

// Bits of an answer's status.
constexpr std::uint8_t kTouching = 1, kCertified = 2, kSideEstimated = 4;

LSDCD_FN std::uint8_t status_of(const Answer &a)
{
  return (a.found() ? kTouching : 0) | (a.certified ? kCertified : 0);
}

// The answer far from the wall.
LSDCD_FN Answer far_answer()
{
  return {kAnyDistance, true, 0};
}

// Of features at the same distance the first in the list is found.
struct FirstOfEqual {
  static constexpr bool kOrders = false;
};

// Tries the entries of a cell's list, the nearest first, as long as they can change the answer.
// `limit`: how many are tried; one more is only a bound. Before decides between features at the same
// distance: before(a, b) says by their codes whether a is found, not b.
template <bool kPrimitives, class Distances, class Before>
LSDCD_FN Answer nearest_in_cell(const GridView &grid, const Vec3 &q, Real radius,
                                std::uint32_t limit, const CellAddress &at, const Cell &cell,
                                const Before &before)
{
  const Distances distances(grid, q, at);
  // Nothing farther than the nearest so far is needed.
  Real nearest = radius;
  FeatureCode found = kNoFeature;
  const auto attempt = [&](FeatureCode code) {
    const Real distance =
        kPrimitives ? distances.primitive(code, nearest) : distances.feature(code, nearest);
    // A sphere touches what is nearer than its radius.
    if (!(Before::kOrders ? distance <= nearest : distance < nearest)) return;
    if constexpr (Before::kOrders)
      if (distance == nearest && (found == kNoFeature || !before(code, found))) return;
    nearest = distance;
    found = code;
  };
  const auto answer = [&](bool certified, std::uint32_t read) -> Answer {
    return {found != kNoFeature ? nearest : kAnyDistance, certified, read, found, kPrimitives};
  };
  // A single candidate is in the cell itself, and there is no list to stop in.
  const bool single = cell.count == 1;
  const Real off_centre = single ? 0 : norm(at.from_centre);
  // The next entry is loaded before this one is tried, which waits for other memory.
  Candidate next = {cell.first, 0};
  if (!single) next = grid.lists.candidates[cell.first];
  for (std::uint32_t k = 0; k < cell.count; k++) {
    const Candidate candidate = next;
    if (!single) {
      if (k + 1 < cell.count) next = grid.lists.candidates[cell.first + k + 1];
      // A distance that may be wrong does not end the search.
      const bool past = candidate.bound > (Distances::kBounded ? nearest : radius) + off_centre;
      if (k == limit || (past && Distances::kBounded)) return answer(past, k + 1);
    }
    attempt(candidate.feature);
  }
  return answer(true, cell.count);
}

// The nearer of two distances, or the first: 0 and -0 are equal, and not the same bits.
LSDCD_FN Real nearer(Real first, Real second)
{
  return second < first ? second : first;
}

// The same from a complete list by the lanes of a warp: they call it together with the same arguments
// and get the same answer. Each lane tries one entry, and its search radius is the nearest distance
// before this turn. The nearest distance that one thread would have had before an entry comes from the
// lanes below, so that the search ends at the same entry as with
// one thread.
template <class Distances, class Threads>
LSDCD_FN Answer nearest_together(const GridView &grid, const Vec3 &q, Real radius,
                                 const CellAddress &at, const Cell &cell, const Threads &warp)
{
  static_assert(Distances::kBounded, "a list is read to its end where bounds do not hold");
  const Distances distances(grid, q, at);
  const Real off_centre = norm(at.from_centre);
  Real nearest = radius;
  const auto answer = [&](std::uint32_t read) -> Answer {
    return {nearest < radius ? nearest : kAnyDistance, true, read};
  };
  for (std::uint32_t first = 0; first < cell.count; first += Threads::kSize) {
    const std::uint32_t k = first + warp.rank();
    const bool there = k < cell.count;
    Real least = nearest;    // of the entries up to this one
    Real bound = 0;
    if (there) {
      const Candidate candidate = grid.lists.candidates[cell.first + k];
      bound = candidate.bound;
      least = nearer(nearest, distances.feature(candidate.feature, nearest));
    }
    for (unsigned step = 1; step < Threads::kSize; step *= 2) {
      const Real below = warp.from_below(least, step);
      if (warp.rank() >= step) least = nearer(below, least);
    }
    Real before = warp.from_below(least, 1);
    if (warp.rank() == 0) before = nearest;
    const unsigned past = warp.vote(there && bound > before + off_centre);
    if (past) {
      const unsigned end = lowest_bit(past);
      nearest = warp.of(before, end);
      return answer(first + end + 1);
    }
    nearest = warp.of(least, Threads::kSize - 1);
  }
  return answer(cell.count);
}

constexpr std::uint32_t kWholeList = 0xffffffffu;

// The nearest point of the wall within `radius` (length, at most grid.cutoff) of q, which lies
// at `at`, in the cell `cell` of grid.lists. kComplete: grid.nearest is 0. Certified answers are
// exact, but for the rounding of Distances.
template <bool kComplete, class Distances, class Before = FirstOfEqual>
LSDCD_FN Answer nearest_from(const GridView &grid, const Vec3 &q, Real radius,
                             const CellAddress &at, const Cell &cell, const Before &before = {})
{
  if (kComplete)
    return nearest_in_cell<false, Distances>(grid, q, radius, kWholeList, at, cell, before);
  return nearest_in_cell<true, Distances>(grid, q, radius, static_cast<std::uint32_t>(grid.nearest),
                                          at, cell, before);
}

// The same for any q.
template <bool kComplete, class Distances, class Before = FirstOfEqual>
LSDCD_FN Answer nearest_distance(const GridView &grid, const Vec3 &q, Real radius,
                                 const Before &before = {})
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return far_answer();
  return nearest_from<kComplete, Distances>(grid, q, radius, at, cell, before);
}

}    // namespace lsdcd
