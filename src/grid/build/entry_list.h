// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A cell's list of entries while it is made.
#pragma once

#include "grid/triangle_grid.h"

namespace lsdcd {

LSDCD_FN CellEntry make_entry(FeatureCode feature, Real distance)
{
  // Rounded down, so that a query that trusts the bound never stops early.
  constexpr Real kLargest = 3e38, kRounding = 1e-6;    // a float has no more
  const Real bound = distance * (distance < 0 ? 1 + kRounding : 1 - kRounding);
  return {feature, static_cast<float>(smaller(bound, kLargest))};
}

LSDCD_FN bool comes_before(const CellEntry &a, const CellEntry &b)
{
  return a.bound < b.bound || (a.bound == b.bound && a.feature < b.feature);
}

// Inserts into the sorted list[0 .. n).
LSDCD_FN void insert_sorted(CellEntry *list, std::uint32_t n, const CellEntry &entry)
{
  while (n > 0 && comes_before(entry, list[n - 1])) {
    list[n] = list[n - 1];
    n--;
  }
  list[n] = entry;
}

// Stores the `room` smallest of all that are offered, one after another. list[0 .. n) has
// those stored so far.
LSDCD_FN void insert_nearest(CellEntry *list, std::uint32_t n, std::uint32_t room,
                             const CellEntry &entry)
{
  if (n < room)
    insert_sorted(list, n, entry);
  else if (comes_before(entry, list[room - 1]))
    insert_sorted(list, room - 1, entry);
}

// In place and without recursion, for a device: moves list[root] down to its place
// in the heap list[0 .. n), whose first entry comes last.
LSDCD_FN void sift_down(CellEntry *list, std::uint32_t root, std::uint32_t n)
{
  const CellEntry entry = list[root];
  while (2 * root + 1 < n) {
    std::uint32_t child = 2 * root + 1;
    if (child + 1 < n && comes_before(list[child], list[child + 1])) child++;
    if (!comes_before(entry, list[child])) break;
    list[root] = list[child];
    root = child;
  }
  list[root] = entry;
}

LSDCD_FN void heap_sort(CellEntry *list, std::uint32_t n)
{
  for (std::uint32_t root = n / 2; root-- > 0;) sift_down(list, root, n);
  for (std::uint32_t last = n; last-- > 1;) {
    const CellEntry top = list[0];
    list[0] = list[last];
    list[last] = top;
    sift_down(list, 0, last);
  }
}

// Longer lists, as at a vertex of very many facets, use a heap: the time of insertion grows
// with the square of the length.
constexpr std::uint32_t kLongList = 64;

}    // namespace lsdcd
