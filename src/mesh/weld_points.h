// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The first step of welding: which corners are the same point.
#pragma once

#include "base/vec3.h"

#include <vector>

namespace lsdcd {

struct WeldedPoints {
  std::vector<Vec3> points;         // coordinates of a corner of the file, never an average
  std::vector<int> corner_point;    // for each corner, its point
};

// Going through the corners in order, one that has no point within `tolerance`
// becomes a point; every other corner goes to the nearest point. No corner moves
// by more than `tolerance` and no two points are closer, so that a chain of close
// corners cannot collapse into one. Coordinates must be finite; tolerance >= 0.
WeldedPoints weld_points(const std::vector<Vec3> &corners, Real tolerance);

// Returns the points of copies of a mesh, of which copy c begins at first[c]. Each goes to the nearest point of the
// copies before it within `tolerance`, if there is one. Points of one copy stay apart, however near they are.
WeldedPoints weld_copies(const std::vector<Vec3> &points, const std::vector<int> &first,
                         Real tolerance);

// Replaces each point p by point onto[p], which stays, in the corners of `from`. The points that stay keep their order.
WeldedPoints move_points(WeldedPoints from, const std::vector<int> &onto);

}    // namespace lsdcd
