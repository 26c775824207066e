// One tangential spring and where it sits.
#pragma once

#include "base/strided_view.h"
#include "base/vec3.h"
#include "geometry/feature_code.h"

#include <cstdint>

namespace lsdcd {

struct Spring {
  Vec3 shear;     // length; lies in the contact's tangent plane
  Vec3 normal;    // unit, wall -> centre, when the spring was last moved
  FeatureCode feature;
  std::uint32_t pad;    // keeps the record free of indeterminate bytes
};

// The springs of many spheres, on the host or on a device: those of sphere i are
// pool[first[i]] .. pool[first[i] + count[i] - 1], with further numbers beside them.
struct SpringsView {
  Column<const int> first, count;
  const Spring *pool;
  const Real *extra;
};

}    // namespace lsdcd
