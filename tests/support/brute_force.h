// Every local minimum of distance by trying all features: no grid, no lists.
#pragma once

#include "geometry/closest_point.h"
#include "grid/triangle_grid.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

struct BruteContact {
  FeatureCode feature;
  Vec3 foot;    // on the wall
  Real distance;
};

// Contacts of a sphere; feet closer than `same` (length) are one contact, the
// nearest of them.
inline std::vector<BruteContact> brute_contacts(const WallFeaturesView &wall,
                                                const std::vector<FeatureCode> &features,
                                                const Vec3 &q, Real radius, Real slack, Real same)
{
  std::vector<BruteContact> all, out;
  for (FeatureCode feature : features) {
    const Foot foot = foot_on(wall, feature, q, slack);
    if (foot.found && foot.distance < radius)
      all.push_back({feature, q - foot.distance * foot.normal, foot.distance});
  }
  std::stable_sort(all.begin(), all.end(), [](const BruteContact &a, const BruteContact &b) {
    return a.distance < b.distance;
  });
  for (const BruteContact &c : all) {
    bool known = false;
    for (const BruteContact &o : out) known = known || norm(c.foot - o.foot) <= same;
    if (!known) out.push_back(c);
  }
  return out;
}

}    // namespace lsdcd
