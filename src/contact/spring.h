// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A tangential spring and its place.
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
  std::uint32_t mesh;    // number of the mesh in the wall, for the feature and the frame
};

// Returns mesh and feature as one double: 53 bits are exact.
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

// A spring as numbers, for exchange and restart files: its place, normal and shear displacement. Both functions return the
// place after it.
constexpr int kPackedSpring = 7;
LSDCD_FN double *pack_spring(const Spring &s, double *to)
{
  *to++ = packed_location(s);
  for (int d = 0; d < 3; d++) *to++ = s.normal[d];
  for (int d = 0; d < 3; d++) *to++ = s.shear[d];
  return to;
}
LSDCD_FN const double *unpack_spring(const double *from, Spring &s)
{
  unpack_location(*from++, s);
  for (int d = 0; d < 3; d++) s.normal[d] = *from++;
  for (int d = 0; d < 3; d++) s.shear[d] = *from++;
  return from;
}

// The springs of many spheres, on the CPU or on a device. Those of sphere i are pool[first[i]] .. pool[first[i] + count[i] -
// 1]; further numbers lie beside them.
struct SpringsView {
  Column<const int> first, count;
  const Spring *pool;
  const Real *extra;
};

}    // namespace lsdcd
