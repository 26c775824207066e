// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the contacts of a sphere: one for each local minimum of the distance.
#pragma once

#include "contact/primitive_contacts.h"

namespace lsdcd {

template <class Entries, int kMost>
LSDCD_FN void find_in_complete(const GridView &grid, const Vec3 &q, Real radius,
                               ContactSet<kMost> &set)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return;
  const MeshGeometry geometry(grid, q);
  if (cell.count == 1) {
    add_feature_noinline(geometry, cell.first, radius, set);
    return;
  }
  // The list is sorted by a bound of the distance from the cell's centre: no feature past this limit can be within the
  // radius.
  const Entries entries(grid.lists);
  const typename Entries::Limit enough = entries.limit(radius + norm(at.from_centre));
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
    const typename Entries::Entry entry = entries[i];
    if (!entries.is_within(entry, enough)) break;
    add_feature_noinline(geometry, entries.feature(entry), radius, set);
    if (set.overflow) break;    // nothing else is valid
  }
}

// Finds contacts on the N primitives of a nearest list: the paper's method of N triangles (section 3.6). Returns the radius
// up to which the set is known to be complete.
template <int kMost>
LSDCD_FN Real find_in_nearest(const GridView &grid, const Vec3 &q, Real radius,
                              ContactSet<kMost> &set)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return kAnyDistance;
  if (cell.count == 1) {
    add_primitive(grid, cell.first, q, radius, set);
    return kAnyDistance;
  }
  const Real off_centre = norm(at.from_centre);
  for (std::uint32_t k = 0; k < cell.count; k++) {
    const CellEntry entry = grid.lists.entries[cell.first + k];
    if (entry.bound > radius + off_centre) break;
    // The tolerance covers the rounding of distances.
    if (k == grid.list_kind.most()) return entry.bound - off_centre - grid.tolerance;
    add_primitive(grid, entry.feature, q, radius, set);
    if (set.overflow) break;
  }
  return kAnyDistance;
}

// Finds the local minima of the distance from q to the wall that are below `radius` (length, at most grid.cutoff). With
// complete lists it finds all of them, with nearest lists those on the listed primitives. Returns the radius up to which
// none can be missing. Entries: the form of the grid's complete lists.
template <class Entries, int kMost>
LSDCD_FN Real find_contacts_in(const GridView &grid, const Vec3 &q, Real radius,
                               ContactSet<kMost> &set)
{
  if (grid.list_kind.has_primitives()) return find_in_nearest(grid, q, radius, set);
  find_in_complete<Entries>(grid, q, radius, set);
  return kAnyDistance;
}

// Finds the contacts in any grid, including grids for queries, whose lists are not packed.
template <int kMost>
LSDCD_FN Real find_contacts(const GridView &grid, const Vec3 &q, Real radius,
                            ContactSet<kMost> &set)
{
  if (!grid.lists.is_packed()) return find_contacts_in<FullEntries>(grid, q, radius, set);
  return find_contacts_in<PackedEntries>(grid, q, radius, set);
}

// Returns the outward pseudonormal of a feature. Its dot product with (q - closest point) tells on which side of a closed
// wall q is (Baerentzen and Aanaes 2005).
LSDCD_FN Vec3 outward(const MeshFeaturesView &wall, FeatureCode feature)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      return wall.faces[i].normal;
    case FeatureKind::edge:
      return wall.edge_out[i];
    default:
      return wall.vertex_out[i];
  }
}

// Keeps spheres on one side of a closed wall: sign +1 outside, -1 inside. The closest point tells on which side the centre
// is. If that is the right side, contacts with the wall's far face are dropped. If it is the wrong side, the nearest
// contact is reversed: with the overlap radius + distance it pushes the sphere back.
template <int kMost>
LSDCD_FN void filter_side(const MeshFeaturesView &wall, Real sign, ContactSet<kMost> &set)
{
  int nearest = 0;
  for (int i = 1; i < set.n; i++)
    if (set.distance[i] < set.distance[nearest]) nearest = i;
  for (int i = set.n - 1; i >= 0; i--) {
    if (sign * dot(outward(wall, set.feature[i]), set.normal[i]) >= 0) continue;
    if (i == nearest) {
      set.normal[i] = -set.normal[i];
      set.distance[i] = -set.distance[i];
    } else {
      if (nearest == set.n - 1) nearest = i;
      set.remove(i);
    }
  }
}

}    // namespace lsdcd
