// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/point_tree.h"

namespace lsdcd {

static std::vector<Box> boxes_of(const std::vector<Vec3> &points)
{
  std::vector<Box> boxes;
  for (const Vec3 &x : points) boxes.push_back({x, x});
  return boxes;
}

PointTree::PointTree(const std::vector<Vec3> &points) : tree_(boxes_of(points))
{
  constexpr std::size_t kSome = 1000;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kSome + 1)
    some_.push_back(points[i]);
}

Vec3 PointTree::farthest_along(const Vec3 &direction) const
{
  Vec3 farthest = some_[0], corner;
  Real most = dot(direction, farthest), at = most;
  const auto may_go_farther = [&](const Box &box) {
    for (int d = 0; d < 3; d++) corner[d] = direction[d] > 0 ? box.hi[d] : box.lo[d];
    at = dot(direction, corner);
    return at > most;
  };
  const auto take = [&](int) {    // the box of this point was tested just before
    farthest = corner;
    most = at;
  };
  for (const Vec3 &x : some_)
    if (may_go_farther({x, x})) take(0);
  tree_.visit(may_go_farther, take);
  return farthest;
}

}    // namespace lsdcd
