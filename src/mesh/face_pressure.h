// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A pressure on a flat face is a third of p times its area on each corner: the moment of that is the pressure's own, and on
// a closed mesh both sums are 0.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// Returns the share of one corner; `sixth`: of the pressure (force/area), which pushes to where the normal points by the
// winding.
LSDCD_FN Vec3 corner_share_of_pressure(const int *face, const Vec3 *at, Real sixth)
{
  const Vec3 &a = at[face[0]];
  return sixth * cross(at[face[1]] - a, at[face[2]] - a);
}

}    // namespace lsdcd
