// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Boxes along the axes.
#pragma once

#include "base/vec3.h"

#include <algorithm>

namespace lsdcd {

struct Box {
  Vec3 lo, hi;    // length
};

// Calls f with each corner of a box.
template <class F>
void for_corners(const Box &box, const F &f)
{
  for (int i = 0; i < 8; i++)
    f(Vec3{i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y, i & 4 ? box.hi.z : box.lo.z});
}

// Makes the box larger where the point lies outside of it.
inline void extend(Box &box, const Vec3 &x)
{
  for (int k = 0; k < 3; k++) {
    box.lo[k] = std::min(box.lo[k], x[k]);
    box.hi[k] = std::max(box.hi[k], x[k]);
  }
}

inline Box box_around(const Vec3 &a, const Vec3 &b, const Vec3 &c)
{
  Box box = {a, a};
  extend(box, b);
  extend(box, c);
  return box;
}

// Do two boxes have a common point?
inline bool overlap(const Box &a, const Box &b)
{
  for (int k = 0; k < 3; k++)
    if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
  return true;
}

constexpr Box kNoLimit = {{-1e300, -1e300, -1e300}, {1e300, 1e300, 1e300}};

}    // namespace lsdcd
