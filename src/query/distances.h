// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances to the entries of a list: to a primitive of the wall in nearest lists, to a feature in
// complete ones. Each returns kAnyDistance if there is nothing nearer than `within`.
#pragma once

#include "contact/brick_geometry.h"
#include "geometry/primitive_distance.h"

namespace lsdcd {

// The wall's own records, in double. Primitives are whole triangles, as in the paper.
class MeshDistances {
 public:
  LSDCD_FN MeshDistances(const GridView &grid, const Vec3 &q, const CellAddress &) :
      grid_(grid), q_(q)
  {
  }

  // No entry of a list is nearer than its bound.
  static constexpr bool kBounded = true;

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

// Copies in float in the frame of a brick. A primitive answers if the wall has a local minimum of
// distance on it. Past a shared side the neighbour answers.
class BrickDistances {
 public:
  LSDCD_FN BrickDistances(const GridView &grid, const Vec3 &q, const CellAddress &at) :
      geometry_(grid, q, at)
  {
  }

  static constexpr bool kBounded = true;

  LSDCD_FN Real primitive(FeatureCode code, Real within) const
  {
    if (feature_kind(code) != FeatureKind::face) return feature(code, within);
    const FaceRegion over = geometry_.over(code, within);
    if (over == FaceRegion::far) return kAnyDistance;
    Real nearest = over == FaceRegion::outside ? kAnyDistance : feature(code, within);
    if (over == FaceRegion::inside) return nearest;
    for (FeatureCode part : geometry_.parts(code).part)
      if (part != kNoFeature) nearest = fmin(nearest, feature(part, within));
    return nearest;
  }
  LSDCD_FN Real feature(FeatureCode code, Real within) const
  {
    const ClosestPoint closest = geometry_.closest_point(code, within);
    return closest.found ? closest.distance : kAnyDistance;
  }

 private:
  BrickGeometry geometry_;
};

}    // namespace lsdcd
