// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A facet's plane and how thin it is, in more digits than its corners have.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct FacePlane {
  Vec3 normal;    // unit, by the winding; zero for a degenerate facet
  Real area;      // length^2
  Real height;    // above the longest edge
  bool degenerate;
};

// Returns the plane of the triangle a, b, c.
FacePlane face_plane(const Vec3 &a, const Vec3 &b, const Vec3 &c);

}    // namespace lsdcd
