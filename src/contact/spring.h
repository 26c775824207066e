// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One tangential spring and where it sits.
#pragma once

#include "base/strided_view.h"
#include "base/vec3.h"
#include "geometry/feature_code.h"

#include <cstdint>

namespace lsdcd {

struct Spring {
  Vec3 shear;     // length; lies in the contact's tangent plane, in the frame of the mesh
  Vec3 normal;    // unit, wall -> centre, when the spring was last moved
  FeatureCode feature;
  std::uint32_t mesh;    // of the wall: the mesh of the feature and of the frame
};

// Mesh and feature as one double, for exchange and restart files: 53 bits are exact.
LSDCD_FN double packed_location(const Spring &s)
{
  return 4294967296. * s.mesh + s.feature;
}
LSDCD_FN void unpack_location(double packed, Spring &s)
{
  const std::uint64_t place = static_cast<std::uint64_t>(packed);
  s.feature = static_cast<FeatureCode>(place);
  s.mesh = static_cast<std::uint32_t>(place >> 32);
}

// The springs of many spheres, on the CPU or on a device: those of sphere i are
// pool[first[i]] .. pool[first[i] + count[i] - 1], with further numbers beside them.
struct SpringsView {
  Column<const int> first, count;
  const Spring *pool;
  const Real *extra;
};

}    // namespace lsdcd
