// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the point that is farthest along a direction, without a test of each point.
#pragma once

#include "mesh/box_tree.h"

#include <vector>

namespace lsdcd {

class PointTree {
 public:
  explicit PointTree(const std::vector<Vec3> &points);    // one at least

  // A point with the largest dot(direction, point).
  Vec3 farthest_along(const Vec3 &direction) const;

 private:
  BoxTree tree_;
  std::vector<Vec3> some_;    // tested first, so that most boxes are skipped
};

}    // namespace lsdcd
