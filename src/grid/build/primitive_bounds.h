// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a primitive that moves: its bounds alone decide, a box and the plane of a face, as its normals turn so that
// no region does. The margin of the plan is how far its nodes may go before the lists are built again:
//
//   distance of a point of the cell to the primitive now <= cutoff
//   => the same distance when the lists were built <= cutoff + way of its nodes <= cutoff + margin
//   => the cell lists the primitive,
//
// as a point of a primitive goes no farther than the farthest of its nodes.
#pragma once

#include "geometry/feature_box.h"
#include "grid/plan/grid_plan.h"

#include <cstdint>

namespace lsdcd {

// Cells that are this much nearer than they need be cover the rounding of distances and of cells.
constexpr Real kCellRounding = 1e-9;

// Returns how far from a primitive cells list it.
LSDCD_FN Real reach_of_moving(const GridPlan &plan)
{
  return (plan.cutoff + plan.margin + plan.tolerance) * (1 + kCellRounding) +
         kCellRounding * plan.length;
}

struct PrimitiveBounds {
  Vec3 lo, hi;
  Vec3 anchor, normal;    // of a face's plane; else the normal is 0

  LSDCD_FN PrimitiveBounds(const MeshFeaturesView &wall, FeatureCode primitive)
  {
    feature_box(wall, primitive, lo, hi);
    anchor = lo;
    normal = {0, 0, 0};
    if (feature_kind(primitive) != FeatureKind::face) return;
    const FaceRecord &face = wall.faces[feature_index(primitive)];
    anchor = face.anchor;
    normal = face.normal;
  }

  LSDCD_FN Real off_plane(const Vec3 &c) const { return fabs(dot(normal, c - anchor)); }

  // Returns a lower bound of the distance from c to the primitive while its nodes go no farther than the margin; it may be
  // below 0.
  LSDCD_FN Real least_distance(const GridPlan &plan, const Vec3 &c) const
  {
    Vec3 past;    // the box
    for (int d = 0; d < 3; d++) past[d] = larger(larger(lo[d] - c[d], c[d] - hi[d]), 0);
    const Real bound = larger(off_plane(c), norm(past));
    return bound - plan.margin - kCellRounding * (bound + plan.length);
  }
};

// Cells [lo, hi) along each axis.
struct CellSpan {
  std::int32_t lo[3], hi[3];

  LSDCD_FN bool is_empty() const { return hi[0] <= lo[0] || hi[1] <= lo[1] || hi[2] <= lo[2]; }
};

// Returns the cells of the grid that the box of a moving primitive reaches.
LSDCD_FN CellSpan cells_reached(const GridPlan &plan, const PrimitiveBounds &of)
{
  const Real reach = reach_of_moving(plan);
  CellSpan cells;
  for (int d = 0; d < 3; d++) {
    const Real n = Real(plan.n_bricks[d]) * kBrickSide;
    const auto number = [&](Real at) {
      return static_cast<std::int32_t>(at > 0 ? (at < n ? at : n) : 0);
    };
    cells.lo[d] = number(floor((of.lo[d] - reach - plan.origin[d]) / plan.length));
    cells.hi[d] = number(floor((of.hi[d] + reach - plan.origin[d]) / plan.length) + 1);
  }
  return cells;
}

}    // namespace lsdcd
