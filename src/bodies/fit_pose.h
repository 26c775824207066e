// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a rigid body is, from where points of it are.
#pragma once

#include "bodies/body_collision.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// Points that tell where a body is: where they are when it is where its mesh has it.
class PosePoints {
 public:
  // At least three, not all on one line; else throws InputError with what is wrong.
  explicit PosePoints(const std::vector<Vec3> &points);
  std::size_t size() const { return from_centre_.size(); }
  Real radius() const { return radius_; }    // root mean square distance from the centre

  // Sums over points of where they are now, which may come from several processes. `origin`: near
  // them, so that little is lost by rounding; the same for all.
  static constexpr int kSums = 14;
  void add(std::size_t point, const Vec3 &x, const Vec3 &origin, double *sums) const;

  // The rigid motion from the points to where they are now that leaves the least mean square
  // distance (Horn 1987), and the root of that.
  BodyPose fit(const double *sums, const Vec3 &origin, Real &off) const;

 private:
  Vec3 centre_ = {0, 0, 0};
  std::vector<Vec3> from_centre_;
  Real radius_ = 0;
};

}    // namespace lsdcd
