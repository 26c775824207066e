// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Closest points on the wall's own records, in double.
#pragma once

#include "geometry/closest_point.h"
#include "grid/lookup/entries.h"
#include "grid/lookup/locate.h"

namespace lsdcd {

class MeshGeometry {
 public:
  LSDCD_FN MeshGeometry(const GridView &grid, const Vec3 &q) : grid_(grid), q_(q) {}

  // Returns the tolerance: closest points that are closer to each other than kSamePoint times this
  // (length) count as one.
  LSDCD_FN static Real tolerance(const GridView &grid) { return grid.tolerance; }
  LSDCD_FN Real tolerance() const { return grid_.tolerance; }

  LSDCD_FN ClosestPoint closest_point(FeatureCode code, Real within,
                                      const FeatureRecord *copy = nullptr) const
  {
    return closest_point_on(grid_.wall, code, q_, grid_.tolerance, within, copy);
  }
  // Prefetches, on a CPU, the records of n entries of a large wall, starting with the first.
  LSDCD_FN static void prefetch([[maybe_unused]] const GridView &grid,
                                [[maybe_unused]] const PackedEntries &entries,
                                [[maybe_unused]] std::uint32_t first,
                                [[maybe_unused]] std::uint32_t n)
  {
#if !LSDCD_ON_GPU()
    for (std::uint32_t i = 0; grid.is_large && i < n; i++)
      lsdcd::prefetch(grid.wall, entries.feature(entries[first + i]));
#endif
  }
  // Returns whether the feature could have a closest point if the tolerance were larger by `more`
  // (length).
  LSDCD_FN bool may_be_closest(FeatureCode code, Real within, Real more) const
  {
    return lsdcd::may_be_closest(grid_.wall, code, q_, grid_.tolerance + more, within);
  }

  LSDCD_FN const FaceParts &parts(FeatureCode face) const
  {
    return grid_.wall.face_parts[feature_index(face)];
  }

 private:
  const GridView &grid_;
  const Vec3 &q_;
};

}    // namespace lsdcd
