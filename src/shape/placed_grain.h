// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grain that is an ellipsoid or a superellipsoid, in its place.
#pragma once

#include "base/quaternion.h"
#include "shape/superellipsoid.h"

namespace lsdcd {

struct PlacedGrain {
  Superellipsoid shape;
  Vec3 centre, row[3];    // rows of the matrix that turns its axes to where they are

  Vec3 turned(const Vec3 &v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Vec3 to_own(const Vec3 &v) const { return v.x * row[0] + v.y * row[1] + v.z * row[2]; }
  Vec3 own_point(const Vec3 &x) const { return to_own(x - centre); }
};

// Returns the grain with this centre, whose axes are turned so.
inline PlacedGrain place_grain(const Superellipsoid &shape, const Vec3 &centre,
                               const Quaternion &turn)
{
  PlacedGrain grain;
  grain.shape = shape;
  grain.centre = centre;
  rows_of(turn, grain.row);
  return grain;
}

// Returns the sphere as a grain.
inline PlacedGrain place_ball(const Vec3 &centre, Real radius)
{
  return place_grain({{radius, radius, radius}, 2, 2, radius, radius, radius}, centre, {});
}

}    // namespace lsdcd
