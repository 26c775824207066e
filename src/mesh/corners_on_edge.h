// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Corners of a mesh that lie on an edge between its ends.
#pragma once

#include "mesh/box_tree.h"

#include <vector>

namespace lsdcd {

class CornersOnEdge {
 public:
  struct On {
    int corner;
    Real along, off;    // lengths, along the edge from its first end and from it
  };

  // For the corners that `used` marks.
  CornersOnEdge(const std::vector<Vec3> &corners, const std::vector<char> &used);

  // The corners within `tolerance` of the edge a b, and nearer to both ends than these are to each
  // other, in order from a to b. The tolerance is at least that of face_plane(), so that a facet with
  // such a corner is degenerate.
  std::vector<On> on(int a, int b, Real tolerance) const;

  // Distance from a point to the nearest of them; infinite where there are none.
  Real distance(const Vec3 &x) const;

 private:
  const std::vector<Vec3> &corners_;
  std::vector<int> used_;
  BoxTree tree_;
};

}    // namespace lsdcd
