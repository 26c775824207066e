// Feet on the wall's own records, in double.
#pragma once

#include "geometry/closest_point.h"
#include "grid/lookup/locate.h"

namespace lsdcd {

// Where a point lies over a face: farther from its plane than asked, past a side, within
// the slack of a side, or inside.
enum class Over { far, outside, rim, inside };

class WallGeometry {
 public:
  LSDCD_FN WallGeometry(const GridView &grid, const Vec3 &q) : grid_(grid), q_(q) {}
  LSDCD_FN WallGeometry(const GridView &grid, const Vec3 &q, const CellAddress &) :
      grid_(grid), q_(q)
  {
  }

  // Feet closer than kSamePoint times this are one (length).
  LSDCD_FN static Real slack(const GridView &grid) { return grid.slack; }
  LSDCD_FN Real slack() const { return grid_.slack; }

  // The feature of the wall that a code in a list stands for.
  LSDCD_FN FeatureCode feature(FeatureCode code) const { return code; }

  LSDCD_FN Foot foot(FeatureCode code, Real within) const
  {
    return foot_on(grid_.wall, code, q_, grid_.slack, within);
  }
  // Could there be a foot with so much more of tolerance (length)?
  LSDCD_FN bool may_have_foot(FeatureCode code, Real within, Real more) const
  {
    return lsdcd::may_have_foot(grid_.wall, code, q_, grid_.slack + more, within);
  }

  LSDCD_FN const FaceParts &parts(FeatureCode face) const
  {
    return grid_.wall.face_parts[feature_index(face)];
  }

  LSDCD_FN Over over(FeatureCode face, Real within) const
  {
    const FaceRecord &f = grid_.wall.faces[feature_index(face)];
    if (!(fabs(dot(f.normal, q_ - f.anchor)) <= within)) return Over::far;
    bool at_rim = false;
    if (!foot_on_face(f, q_, grid_.slack, within, at_rim).found) return Over::outside;
    return at_rim ? Over::rim : Over::inside;
  }

 private:
  const GridView &grid_;
  const Vec3 &q_;
};

}    // namespace lsdcd
