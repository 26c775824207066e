// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The primitives of the wall that may meet a piece of the body (section 3.7 of the paper).
//
// Why no pair is missed. A pair meets at a point x, which is in a piece of the body's triangle, so
// within the piece's radius of its centre c. The list of c's cell holds every triangle of the wall
// within the grid's cutoff of any point of the cell; with a cutoff of at least the radius the
// triangle that holds x is one of them. So lists must hold triangles: a complete list of faces,
// edges and vertices leaves out those that cannot be closest to any point of the cell, and a
// triangle behind its neighbour's fold is one of these though the piece cuts it.
//
// A primitive is left out if its distance from c, rounded, exceeds the radius + the grid's
// tolerance, which covers that rounding. Centres are rounded, too, with u = 2^-53 and the largest coordinate X: by
// u X a bisection, of which there are at most 64, and then by the pose, as the corners are. The sum is below 128 u X,
// by which the cutoff must exceed the radius.
#pragma once

#include "bodies/body_collision.h"
#include "bodies/subdivide.h"
#include "geometry/primitive_distance.h"
#include "grid/build/meets.h"
#include "grid/lookup/locate.h"

namespace lsdcd {

// Returns the grid's primitive as a triangle, for exact tests.
LSDCD_FN Triangle wall_triangle(const MeshFeaturesView &wall, FeatureCode primitive)
{
  const std::uint32_t i = feature_index(primitive);
  const auto at = [&](std::int32_t v) { return wall.vertices[v].position; };
  switch (feature_kind(primitive)) {
    case FeatureKind::face: {
      const FaceVertices &f = wall.face_vertex[i];
      return {{at(f.v[0]), at(f.v[1]), at(f.v[2])}};
    }
    case FeatureKind::edge: {
      const EdgeVertices &e = wall.edge_vertex[i];
      return {{at(e.v[0]), at(e.v[1]), at(e.v[1])}};
    }
    default: {
      const auto v = static_cast<std::int32_t>(i);
      return {{at(v), at(v), at(v)}};
    }
  }
}

LSDCD_FN Triangle body_triangle(const Vec3 *corners, std::uint32_t triangle, const BodyPose &pose)
{
  const Vec3 *c = corners + 3 * std::size_t(triangle);
  return {{pose.corner_at(c[0]), pose.corner_at(c[1]), pose.corner_at(c[2])}};
}

// Calls visit(primitive) for the primitives of the wall that overlap a ball, from the list of its
// centre's cell. Returns whether that list is shortened.
template <class Visit>
LSDCD_FN bool for_each_candidate(const GridView &grid, const Vec3 &centre, Real radius,
                                 const Visit &visit)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, centre, at, cell)) return false;
  const std::uint32_t most = grid.list_kind.most();
  const std::uint32_t n = cell.count < most ? cell.count : most;
  for (std::uint32_t k = 0; k < n; k++) {
    const FeatureCode code =
        cell.count == 1 ? cell.first : grid.lists.entries[cell.first + k].feature;
    const std::uint32_t i = feature_index(code);
    Real distance;
    if (feature_kind(code) == FeatureKind::face
            ? face_meets(grid.wall.faces[i], centre, radius, 0, distance)
            : primitive_distance(grid.wall, code, centre) <= radius)
      visit(code);
  }
  return cell.count > most;
}

// Was this primitive reported by the previous piece of the same triangle, whose ball it overlaps? Then this piece
// skips it, so that large triangles give one pair for each run of
// pieces.
LSDCD_FN bool is_of_piece_before(const GridView &grid, const Piece *pieces, std::size_t i,
                                 const BodyPose &pose, Real unit, FeatureCode primitive)
{
  if (i == 0 || !grid.list_kind.is_every()) return false;
  const Piece before = pieces[i - 1];
  return before.triangle == pieces[i].triangle &&
         primitive_distance(grid.wall, primitive, pose.corner_at(before.centre)) <=
             unit * before.radius;
}

}    // namespace lsdcd
