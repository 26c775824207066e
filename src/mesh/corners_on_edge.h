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

  // Of the corners that `used` marks.
  CornersOnEdge(const std::vector<Vec3> &corners, const std::vector<char> &used);

  // Those no farther than `tolerance` from the edge a b and nearer to both ends than these to each
  // other, from a to b. The tolerance is no less than that by which a facet with such a corner
  // is degenerate (face_plane()).
  std::vector<On> on(int a, int b, Real tolerance) const;

  // Distance from a point to the nearest of them; infinite where there are none.
  Real distance(const Vec3 &x) const;

 private:
  const std::vector<Vec3> &corners_;
  std::vector<int> used_;
  BoxTree tree_;
};

}    // namespace lsdcd
