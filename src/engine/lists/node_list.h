// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbour lists of spheres at a mesh whose nodes move. A list names whole primitives, faces with their edges and
// vertices, by their distance alone: a primitive at a distance d now is at least d - way of the sphere - way of the
// nodes away later, however its normal turns. So a list of all within
//
//   cutoff + margin of the list + NodeField::going
//
// is complete while the sphere is within the margin and no node has gone farther than `going`; then the host chooses
// candidates, and with them all lists, anew.
#pragma once

#include "contact/node_field.h"
#include "engine/lists/feature_list.h"
#include "geometry/primitive_distance.h"

namespace lsdcd {

// The list of a sphere for a margin, from its cell, which lists what is so near; false: it is too long.
inline bool gather_primitives(const GridView &grid, const QuerySphere &s, Real margin, Real going,
                              FeatureList &list)
{
  begin_list(list, s.x, s.cutoff, margin);
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, s.x, at, cell)) return true;
  // As long as lists hold; see FeatureLists::put().
  const Real within = (1 + Real(2e-6)) * s.cutoff + margin + going + grid.tolerance;
  const auto add = [&](FeatureCode code) {
    return !(primitive_distance(grid.wall, code, s.x) <= within) || insert_code(list, code);
  };
  if (cell.count == 1) return add(cell.first);
  const Real enough = within + norm(at.from_centre);
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
    const Candidate candidate = grid.lists.candidates[i];
    if (candidate.bound > enough) break;
    if (!add(candidate.feature)) return false;
  }
  return true;
}

// For a way of a share of its radius, or less where that is too long.
inline void gather_nodes(const GridView &grid, const QuerySphere &s, Real going, FeatureList &list)
{
  Real margin = kSkinFraction * s.radius;
  for (int i = 0; i <= kMaxShrinks; i++, margin /= kShrink)
    if (gather_primitives(grid, s, margin, going, list)) return;
  begin_list(list, s.x, s.cutoff, -1);
}

// Local minima of the distance from q to the listed primitives.
template <int kCapacity>
LSDCD_FN void find_in_node_list(const GridView &grid, const ListedFeatures &list, const Vec3 &q,
                                Real cutoff, ContactSet<kCapacity> &set)
{
  const int n = list.lists.size(list.k);
  const MeshGeometry geometry(grid, q);
  for (int i = 0; i < n && !set.overflow; i++)
    add_primitive(geometry, list.lists.code(list.k, i), cutoff, set);
}

}    // namespace lsdcd
