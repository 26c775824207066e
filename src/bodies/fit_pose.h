// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The pose of a rigid body, from the positions of some of its points.
#pragma once

#include "bodies/body_collision.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// The positions of these points when the body is where its mesh file has it.
class PosePoints {
 public:
  // At least three, not all on one line; else throws InputError with what is wrong.
  explicit PosePoints(const std::vector<Vec3> &points);
  std::size_t size() const { return from_centre_.size(); }
  Real radius() const { return radius_; }    // root mean square distance from the centre

  // Sums over the present positions of points, which several processes may have. `origin`: a point near
  // them, for less rounding; the same on all processes.
  static constexpr int kSums = 14;
  void add(std::size_t point, const Vec3 &x, const Vec3 &origin, double *sums) const;

  // Returns the rigid motion of the points to their present positions with the least mean square distance (Horn 1987),
  // and the square root of that.
  BodyPose fit(const double *sums, const Vec3 &origin, Real &off) const;

 private:
  Vec3 centre_ = {0, 0, 0};
  std::vector<Vec3> from_centre_;
  Real radius_ = 0;
};

}    // namespace lsdcd
