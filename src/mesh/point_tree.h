// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which of many points goes farthest along a direction, without a look at each of them.
#pragma once

#include "mesh/box_tree.h"

#include <vector>

namespace lsdcd {

class PointTree {
 public:
  explicit PointTree(const std::vector<Vec3> &points);    // one at least

  // One of those whose dot(direction, point) is largest.
  Vec3 farthest_along(const Vec3 &direction) const;

 private:
  BoxTree tree_;
  std::vector<Vec3> some_;    // asked first, so that most boxes are passed over
};

}    // namespace lsdcd
