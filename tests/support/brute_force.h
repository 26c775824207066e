// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds every local minimum of distance by trying all features, without grid and lists.
#pragma once

#include "geometry/closest_point.h"
#include "grid/triangle_grid.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

struct BruteContact {
  FeatureCode feature;
  Vec3 closest;    // on the wall
  Real distance;
};

// Contacts of a sphere; closest points closer than `same` (length) are one contact, the
// nearest of them.
inline std::vector<BruteContact> brute_contacts(const MeshFeaturesView &wall,
                                                const std::vector<FeatureCode> &features,
                                                const Vec3 &q, Real radius, Real tolerance,
                                                Real same)
{
  std::vector<BruteContact> all, out;
  for (FeatureCode feature : features) {
    const ClosestPoint closest = closest_point_on(wall, feature, q, tolerance);
    if (closest.found && closest.distance < radius)
      all.push_back({feature, q - closest.distance * closest.normal, closest.distance});
  }
  std::stable_sort(all.begin(), all.end(), [](const BruteContact &a, const BruteContact &b) {
    return a.distance < b.distance;
  });
  for (const BruteContact &c : all) {
    bool known = false;
    for (const BruteContact &o : out) known = known || norm(c.closest - o.closest) <= same;
    if (!known) out.push_back(c);
  }
  return out;
}

}    // namespace lsdcd
