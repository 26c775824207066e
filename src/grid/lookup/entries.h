// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The entries of cells as searches of complete lists read them, by one interface for both forms.
#pragma once

#include "grid/triangle_grid.h"

namespace lsdcd {

class FullEntries {
 public:
  using Entry = CellEntry;
  using Limit = Real;

  LSDCD_FN explicit FullEntries(const CellListsView &lists) : first_(lists.entries) {}
  LSDCD_FN Entry operator[](std::uint32_t i) const { return first_[i]; }
  LSDCD_FN FeatureCode feature(const Entry &c) const { return c.feature; }
  LSDCD_FN Limit limit(Real length) const { return length; }
  // May the entry be as near to the cell's centre as the limit? True wherever it is.
  LSDCD_FN bool is_within(const Entry &c, Limit limit) const { return c.bound <= limit; }
  // Is bound + away < close? A packed entry says so only where it is sure. Lengths.
  LSDCD_FN bool is_below(const Entry &c, Real away, Real close) const
  {
    return c.bound + away < close;
  }

 private:
  const CellEntry *first_;
};

// Entries of lists that are packed.
class PackedEntries {
 public:
  using Entry = PackedEntry;
  using Limit = std::uint32_t;

  LSDCD_FN explicit PackedEntries(const CellListsView &lists) : lists_(lists) {}
  LSDCD_FN Entry operator[](std::uint32_t i) const { return lists_.packed[i]; }
  LSDCD_FN FeatureCode feature(Entry c) const { return lists_.packing.feature(c); }
  LSDCD_FN Limit limit(Real length) const { return lists_.packing.steps(length); }
  LSDCD_FN bool is_within(Entry c, Limit limit) const { return lists_.packing.bound(c) <= limit; }
  LSDCD_FN bool is_below(Entry c, Real away, Real close) const
  {
    return lists_.packing.bound(c) < lists_.packing.steps(close - away);
  }

 private:
  const CellListsView &lists_;
};

}    // namespace lsdcd
