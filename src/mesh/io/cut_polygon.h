// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From a polygon of a file to triangles; private to the mesh room.
#pragma once

#include "base/vec3.h"
#include "mesh/hash_index.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// Appends the triangles, three corners each, of a polygon with three or more corners, in its winding.
// Together they are the polygon: it may be concave, have collinear or repeated corners, and holes that
// bridges join to its rim (keyholes). Every corner is one of a triangle, so that a neighbour that has it too
// still fits. There are n - 2 triangles for n corners, less those that would have two equal corners;
// triangles of collinear corners have no area.
//
// A polygon that is not flat is cut as it looks along an axis, the one along which its area is largest. A
// quadrilateral is cut from its first corner to its third, or across if only that is inside.
//
// Returns an empty text; or, and then no triangle is appended, why the polygon cannot be cut and where:
// "it crosses itself near (1, 2, 0)". For n corners it takes time in proportion to n log n, and to
// n^2 for the worst: 1e5 corners take half a second, as a star of long spikes 12 s.
std::string cut_polygon(const std::vector<Vec3> &corners, std::vector<Vec3> &triangles);

// Cuts all polygons of a file. One that is there again gets the triangles that it had, turned over where it is: the
// facets of a double-sided export are then there in both windings, and none lies across another.
class PolygonCutter {
 public:
  // As cut_polygon(). All calls append to the same triangles.
  std::string cut(const std::vector<Vec3> &corners, std::vector<Vec3> &triangles);

 private:
  struct Cut {
    std::size_t corner, n;           // in corners_
    std::size_t triangle, behind;    // where its triangles begin and end
  };

  std::vector<Cut> cuts_;
  std::vector<Vec3> corners_;
  HashIndex known_cuts_;
};

// For the message of a face that cannot be cut.
constexpr const char *kTriangulate = "mend it, or triangulate the mesh when exporting it";

}    // namespace lsdcd
