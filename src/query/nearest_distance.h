// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the distance from one sphere to the wall, and whether it is certified.
#pragma once

#include "geometry/primitive_distance.h"
#include "query/brick_distances.h"

#include <cstdint>

namespace lsdcd {

// Distances to the entries of a list: to a primitive of the wall in lists of the N nearest, to a feature in complete
// lists. Each function returns kAnyDistance if nothing is nearer than `within`.

// Distances by the wall's own records, in double. Primitives are whole triangles, as in the paper.
class MeshDistances {
 public:
  static constexpr bool kFloats = false;

  LSDCD_FN MeshDistances(const GridView &grid, const Vec3 &q, const CellAddress &) :
      grid_(grid), q_(q)
  {
  }

  LSDCD_FN Real primitive(FeatureCode code, Real) const
  {
    return primitive_distance(grid_.wall, code, q_);
  }
  LSDCD_FN Real feature(FeatureCode code, Real within) const
  {
    const ClosestPoint closest = closest_point_on(grid_.wall, code, q_, grid_.tolerance, within);
    return closest.found ? closest.distance : kAnyDistance;
  }

 protected:
  const GridView &grid_;
  const Vec3 &q_;
};

// How a grid is searched: by which distances, and whether its lists are complete.
template <class D, bool kAll>
struct ListSearch {
  using Distances = D;
  static constexpr bool kComplete = kAll;
};

// Calls run(search) with the ListSearch that the grid's lists and records need.
template <class Run>
void with_list_search(const GridView &grid, const Run &run)
{
  const bool complete = grid.list_kind.is_complete();
  if (grid.in_floats && complete)
    run(ListSearch<BrickDistances, true>());
  else if (grid.in_floats)
    run(ListSearch<BrickDistances, false>());
  else if (complete)
    run(ListSearch<MeshDistances, true>());
  else
    run(ListSearch<MeshDistances, false>());
}

struct Answer {
  Real distance;     // from the centre to the wall; kAnyDistance: not within the radius
  bool certified;    // nothing that the list leaves out can be nearer, or touch
  // The code in the list of the nearest feature or primitive, and whether it is a primitive; not set by
  // nearest_in_warp().
  FeatureCode feature = kNoFeature;
  bool primitive = false;

  LSDCD_FN bool found() const { return distance < kAnyDistance; }
};

// Bits of an answer's status.
constexpr std::uint8_t kFound = 1, kCertified = 2, kSideEstimated = 4;

LSDCD_FN std::uint8_t status_of(const Answer &a)
{
  return (a.found() ? kFound : 0) | (a.certified ? kCertified : 0);
}

// Returns the answer far from the wall.
LSDCD_FN Answer far_answer()
{
  return {kAnyDistance, true};
}

// Decides that of features at the same distance the first one in the list is found.
struct FirstOfEqual {
  static constexpr bool kOrders = false;
};

// Tries the entries of a cell's list, the nearest first, as long as they can change the answer: the detection of
// function (2) of the paper. `limit`: how many are tried; one more is only a bound. Before decides between features at
// the same distance: before(a, b) returns, by their codes, whether a is found instead of b.
template <bool kPrimitives, class Distances, class Before>
LSDCD_FN Answer nearest_in_cell(const GridView &grid, const Vec3 &q, Real radius,
                                std::uint32_t limit, const CellAddress &at, const Cell &cell,
                                const Before &before)
{
  const Distances distances(grid, q, at);
  // Nothing farther than the nearest one so far is needed.
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
  const auto answer = [&](bool certified) -> Answer {
    return {found != kNoFeature ? nearest : kAnyDistance, certified, found, kPrimitives};
  };
  // A single entry is in the cell itself, and there is no list to stop in.
  const bool single = cell.count == 1;
  const Real off_centre = single ? 0 : norm(at.from_centre);
  // The next entry is loaded before this one is tried, because that waits for other memory.
  CellEntry next = {cell.first, 0};
  if (!single) next = grid.lists.entries[cell.first];
  for (std::uint32_t k = 0; k < cell.count; k++) {
    const CellEntry entry = next;
    if (!single) {
      if (k + 1 < cell.count) next = grid.lists.entries[cell.first + k + 1];
      // No entry from here on is nearer than this bound.
      const bool past = entry.bound > nearest + off_centre;
      if (k == limit || past) return answer(past);
    }
    attempt(entry.feature);
  }
  return answer(true);
}

// Returns the nearer of two distances, or the first if they are equal: 0 and -0 are equal, but do not have the same
// bits.
LSDCD_FN Real nearer(Real first, Real second)
{
  return second < first ? second : first;
}

// Finds the nearest distance from a complete list with the lanes of a warp, which call it with the same arguments and
// get the same answer. Each lane tries one entry, and its search radius is the nearest distance before this round. The
// nearest distance that a single thread would have had before an entry comes from the lower lanes, so that the search
// ends at the same entry as with one thread.
template <class Distances, class Threads>
LSDCD_FN Answer nearest_in_warp(const GridView &grid, const Vec3 &q, Real radius,
                                const CellAddress &at, const Cell &cell, const Threads &warp)
{
  const Distances distances(grid, q, at);
  const Real off_centre = norm(at.from_centre);
  Real nearest = radius;
  const auto answer = [&]() -> Answer { return {nearest < radius ? nearest : kAnyDistance, true}; };
  for (std::uint32_t first = 0; first < cell.count; first += Threads::kSize) {
    const std::uint32_t k = first + warp.rank();
    const bool there = k < cell.count;
    Real least = nearest;    // of the entries up to this one
    Real bound = 0;
    if (there) {
      const CellEntry entry = grid.lists.entries[cell.first + k];
      bound = entry.bound;
      least = nearer(nearest, distances.feature(entry.feature, nearest));
    }
    for (unsigned step = 1; step < Threads::kSize; step *= 2) {
      const Real below = warp.from_below(least, step);
      if (warp.rank() >= step) least = nearer(below, least);
    }
    Real before = warp.from_below(least, 1);
    if (warp.rank() == 0) before = nearest;
    const unsigned past = warp.vote(there && bound > before + off_centre);
    if (past) {
      nearest = warp.of(before, lowest_bit(past));
      return answer();
    }
    nearest = warp.of(least, Threads::kSize - 1);
  }
  return answer();
}

constexpr std::uint32_t kWholeList = 0xffffffffu;

// Returns the nearest point of the wall within `radius` (length, at most grid.cutoff) of q, which lies at `at`, in the
// cell `cell` of grid.lists. Certified answers are exact, except for the rounding of Search::Distances.
template <class Search, class Before = FirstOfEqual>
LSDCD_FN Answer nearest_from(const GridView &grid, const Vec3 &q, Real radius,
                             const CellAddress &at, const Cell &cell, const Before &before = {})
{
  using Distances = typename Search::Distances;
  if (Search::kComplete)
    return nearest_in_cell<false, Distances>(grid, q, radius, kWholeList, at, cell, before);
  return nearest_in_cell<true, Distances>(grid, q, radius, grid.list_kind.most(), at, cell, before);
}

// Returns the nearest point of the wall within `radius` of any q, as nearest_from() does for a q in a known cell.
template <class Search, class Before = FirstOfEqual>
LSDCD_FN Answer nearest_distance(const GridView &grid, const Vec3 &q, Real radius,
                                 const Before &before = {})
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return far_answer();
  return nearest_from<Search>(grid, q, radius, at, cell, before);
}

}    // namespace lsdcd
