// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where the triangles of a flow surface may be, for kernels on any device.
#pragma once

#include "box/periodic_box.h"
#include "mesh/box_tree.h"

namespace lsdcd {

// The boxes around triangles, and around those of all their periodic images.
struct FlowBoxes {
  BoxTreeView tree;
  Box in_fractions;    // bounds of all triangles, in units of the periodic box
  PeriodicFaces faces;
  Vec3 edge[3];    // of the periodic box: length
  bool any_periodic;
  Real largest;    // of the numbers above that are lengths

  // `tree`: in memory of the device that asks.
  FlowBoxes(const BoxTreeView &tree, const Box &bounds, const PeriodicBox &box);

  LSDCD_FN Vec3 fraction(const Vec3 &x) const
  {
    const Vec3 d = x - faces.corner;
    return {dot(faces.gradient[0], d), dot(faces.gradient[1], d), dot(faces.gradient[2], d)};
  }

  // Returns `from` by the image that is next to `to`.
  LSDCD_FN Vec3 beside(const Vec3 &from, const Vec3 &to) const
  {
    Vec3 at = from;
    if (!any_periodic) return at;
    const Vec3 apart = fraction(to) - fraction(from);
    for (int k = 0; k < 3; k++)
      if (faces.periodic[k]) at += std::nearbyint(apart[k]) * edge[k];
    return at;
  }

  // May a triangle have a point in the box from lo to hi? False is certain: there is room for rounding.
  LSDCD_FN bool may_meet(Vec3 lo, Vec3 hi) const
  {
    Real most = largest;
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(fabs(lo[k]), fabs(hi[k])));
    const Real room = kRoom * most;
    lo -= Vec3{room, room, room};
    hi += Vec3{room, room, room};
    if (!any_periodic) return meets(lo, hi);
    // The images that may be there, as numbers of edges.
    const Vec3 middle = fraction(0.5 * (lo + hi)), half = 0.5 * (hi - lo);
    Vec3 first = {0, 0, 0}, last = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
      if (!faces.periodic[k]) continue;
      const Vec3 &g = faces.gradient[k];
      const Real reach = fabs(g.x) * half.x + fabs(g.y) * half.y + fabs(g.z) * half.z + kRoom;
      first[k] = ceil(middle[k] - reach - in_fractions.hi[k]);
      last[k] = floor(middle[k] + reach - in_fractions.lo[k]);
    }
    Vec3 cells;
    for (cells.x = first.x; cells.x <= last.x; cells.x++)
      for (cells.y = first.y; cells.y <= last.y; cells.y++)
        for (cells.z = first.z; cells.z <= last.z; cells.z++) {
          const Vec3 shift = cells.x * edge[0] + cells.y * edge[1] + cells.z * edge[2];
          if (meets(lo - shift, hi - shift)) return true;
        }
    return false;
  }

 private:
  static constexpr Real kRoom = 1e-9;    // a share of the largest number that comes in

  LSDCD_FN bool meets(const Vec3 &lo, const Vec3 &hi) const
  {
    return tree.any([&](const Box &b) {
      return b.lo.x <= hi.x && b.lo.y <= hi.y && b.lo.z <= hi.z && lo.x <= b.hi.x &&
             lo.y <= b.hi.y && lo.z <= b.hi.z;
    });
  }
};

}    // namespace lsdcd
