// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbour lists of spheres at a mesh whose nodes move. A list names whole primitives, faces with their edges and
// vertices, by their distance alone: a primitive at a distance d now is at least d - way of the sphere - way of the
// nodes away later, however its normal turns. So a list of all within
//
//   cutoff + margin of the list + NodeField::going
//
// is complete while the sphere is within the margin and no node has gone farther than `going`; then the host chooses
// candidates, and with them all lists, again.
#pragma once

#include "contact/node_field.h"
#include "engine/lists/feature_list.h"
#include "geometry/primitive_distance.h"

namespace lsdcd {

// A point over a face that moves.
struct OverFace {
  Real height, side[3],
      least;    // signed distances from its plane and its sides, and the least of these

  LSDCD_FN OverFace(const FaceRecord &f, const Vec3 &q)
  {
    const Vec3 d = q - f.anchor;
    height = dot(f.normal, d);
    side[0] = dot(f.inward[0], d);
    side[1] = dot(f.inward[1], d) + f.height;
    side[2] = dot(f.inward[2], d);
    least = side[0] < side[1] ? side[0] : side[1];
    if (side[2] < least) least = side[2];
  }
  // Is the face surely farther than this? Past a side its distance is at least that in the plane of height and side. The
  // factor covers rounding.
  LSDCD_FN bool is_past(Real within) const
  {
    const Real past = least < 0 ? least : 0;
    return height * height + past * past > (1 + Real(1e-9)) * (within * within);
  }
};

// The list of a sphere for a margin, from its cell, which lists what is so near; false: it is too long.
LSDCD_FN bool gather_primitives(const GridView &grid, const QuerySphere &s, Real margin, Real going,
                                FeatureList &list)
{
  begin_list(list, s.x, s.cutoff, margin);
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, s.x, at, cell)) return true;
  // As long as lists hold; see FeatureLists::put().
  const Real within = (1 + Real(2e-6)) * s.cutoff + margin + going + grid.tolerance;
  const auto add = [&](FeatureCode code) {
    if (feature_kind(code) == FeatureKind::face &&
        OverFace(grid.wall.faces[feature_index(code)], s.x).is_past(within))
      return true;
    return !(primitive_distance(grid.wall, code, s.x) <= within) || insert_code(list, code);
  };
  if (cell.count == 1) return add(cell.first);
  const Real enough = within + norm(at.from_centre);
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
    const CellEntry entry = grid.lists.entries[i];
    if (entry.bound > enough) break;
    if (!add(entry.feature)) return false;
  }
  return true;
}

// For a way of a share of its radius, or less where that is too long.
LSDCD_FN void gather_nodes(const GridView &grid, const QuerySphere &s, Real going,
                           FeatureList &list)
{
  Real margin = kSkinFraction * s.radius;
  for (int i = 0; i <= kMaxShrinks; i++, margin /= kShrink)
    if (gather_primitives(grid, s, margin, going, list)) return;
  begin_list(list, s.x, s.cutoff, -1);
}

// What of a face at whose rim or past which q is can have a contact, by the point over the face alone: bit k is edge k, bit
// 3 + k vertex k, bit 6 the face. An edge has one only where q is past its side; twice the tolerance covers the rounding
// between the two tests. A vertex is at least as far as the lines of its two edges.
LSDCD_FN unsigned parts_in_reach(const OverFace &over, Real cutoff, Real tolerance)
{
  const Real within = cutoff + tolerance,
             beside_sq = (1 + Real(1e-9)) * (within * within) - over.height * over.height;
  unsigned parts = over.least >= -tolerance ? 64 : 0;
  bool is_near[3];
  for (int k = 0; k < 3; k++) {
    parts |= static_cast<unsigned>(over.side[k] <= 2 * tolerance) << k;
    is_near[k] = over.side[k] * over.side[k] <= beside_sq;
  }
  for (int k = 0; k < 3; k++)
    parts |= static_cast<unsigned>(is_near[k] & is_near[(k + 2) % 3]) << (3 + k);
  return parts;
}

// The contacts of these parts. Where q is over the inside of a face, `inside`, or kNoFeature, that face's edges have none.
template <int kMost>
LSDCD_NOINLINE void add_rim(const MeshGeometry &geometry, const GridView &grid, FeatureCode face,
                            unsigned in_reach, FeatureCode inside, const Vec3 &q, Real cutoff,
                            ContactSet<kMost> &set)
{
  const FaceParts &parts = geometry.parts(face);
  const Real within_sq = (1 + Real(1e-9)) * (cutoff * cutoff);
  const auto is_of_inside = [&](FeatureCode edge) {
    if (inside == kNoFeature) return false;
    const FaceParts &of = geometry.parts(inside);
    return edge == of.part[0] || edge == of.part[1] || edge == of.part[2];
  };
  for (int k = 0; k < 3; k++) {
    const FeatureCode edge = parts.part[k], vertex = parts.part[3 + k];
    if (in_reach >> k & 1 && edge != kNoFeature && !is_of_inside(edge))
      add_feature_noinline(geometry, edge, cutoff, set);
    if (in_reach >> (3 + k) & 1 && vertex != kNoFeature &&
        norm_sq(q - grid.wall.vertices[feature_index(vertex)].position) <= within_sq)
      add_feature_noinline(geometry, vertex, cutoff, set);
  }
  if (in_reach & 64) add_feature_noinline(geometry, face, cutoff, set);
}

// On a CPU: prefetches the records of the first faces of a list whose turn comes soon.
LSDCD_FN void prefetch_node_list([[maybe_unused]] const GridView &grid,
                                 [[maybe_unused]] const FeatureLists &lists,
                                 [[maybe_unused]] std::size_t k)
{
#if !LSDCD_ON_GPU()
  if (k >= lists.column) return;
  for (int i = 0; i < 3; i++)
    prefetch(grid.wall, feature_code(FeatureKind::face, feature_index(lists.code(k, i))));
#endif
}

// Local minima of the distance from q to the listed primitives, as add_primitive() finds them. The record of a face
// alone tells for most that they are too far, or that q is over the inside, where only the face is near.
template <int kCapacity>
LSDCD_FN void find_in_node_list(const GridView &grid, const ListedFeatures &list, const Vec3 &q,
                                Real cutoff, ContactSet<kCapacity> &set)
{
  constexpr std::size_t kAhead = 6;
  prefetch_node_list(grid, list.lists, list.k + kAhead);
  const MeshGeometry geometry(grid, q);
  FeatureCode rim[FeatureList::kMax], inside = kNoFeature;
  unsigned in_reach[FeatureList::kMax];
  int n_rim = 0;
  const int n = list.lists.size(list.k);
  for (int i = 0; i < n; i++) {
    const FeatureCode code = list.lists.code(list.k, i);
    if (feature_kind(code) != FeatureKind::face) {
      add_feature_noinline(geometry, code, cutoff, set);
      continue;
    }
    const FaceRecord &face = grid.wall.faces[feature_index(code)];
    const OverFace over(face, q);
    const Real distance = fabs(over.height);
    if (!(distance < cutoff) || over.is_past(cutoff)) continue;
    if (!(over.least >= grid.tolerance)) {
      rim[n_rim] = code;
      in_reach[n_rim++] = parts_in_reach(over, cutoff, grid.tolerance);
      continue;
    }
    if (over.least >= 2 * grid.tolerance) inside = code;
    add_once(set, code, {true, distance, over.height < 0 ? -face.normal : face.normal},
             grid.tolerance);
  }
  for (int i = 0; i < n_rim && !set.overflow; i++)
    add_rim(geometry, grid, rim[i], in_reach[i], inside, q, cutoff, set);
}

}    // namespace lsdcd
