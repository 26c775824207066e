// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The straight path of a centre in one step, and whether it passes through a triangle.
#pragma once

#include "base/vec3.h"
#include "box/periodic_box.h"

namespace lsdcd {

// `at`, moved by whole numbers of edges of the box. Not added up: that would round.
struct WrappedPoint {
  Vec3 at;
  Vec3 cells = {0, 0, 0};
};

// Answers are as if all centres were moved by the same vector (e, e^2, e^3) with e smaller than any
// number (simulation of simplicity, Edelsbrunner 1990). Signs that rounding could change are computed
// exactly. So no centre is on a triangle and no path meets an edge or a vertex. Paths that join end to
// end leave no gap and count nothing twice, nor do
// adjacent triangles.
class Path {
 public:
  Path(const WrappedPoint &from, const WrappedPoint &to, const PeriodicBox &box);

  // Through the triangle: 1 along its normal, -1 against it, else 0.
  int crosses(const Vec3 &a, const Vec3 &b, const Vec3 &c) const;

  // Returns a box around its ends, with room for rounding.
  Box bounds() const;

 private:
  int side(int end, const Vec3 &a, const Vec3 &b, const Vec3 &c) const;
  int exact_side(int end, const Vec3 &a, const Vec3 &b, const Vec3 &c) const;
  int turn(const Vec3 &a, const Vec3 &b) const;
  int exact_turn(const Vec3 &a, const Vec3 &b) const;

  WrappedPoint end_[2];
  const PeriodicBox &box_;
  Vec3 unwrapped_[2];    // the ends, rounded
  Real largest_;         // of all numbers that they were added up of
};

}    // namespace lsdcd
