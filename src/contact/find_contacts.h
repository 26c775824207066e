// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// From a sphere to its contacts: one for each local minimum of distance.
#pragma once

#include "contact/contact_set.h"
#include "contact/mesh_geometry.h"

namespace lsdcd {

// The tolerance lets two features answer at a seam. Their closest points are then at most this
// many tolerances apart, as each is off by at most two.
constexpr Real kSamePoint = 4;

// Adds a contact unless the set already has one at the same point of the wall. Then the
// nearer one stays, or the lower feature, whatever the order. A closest point between two
// others merges all three.
template <int kMost>
LSDCD_FN void add_once(ContactSet<kMost> &set, FeatureCode feature, const ClosestPoint &closest,
                       Real tolerance)
{
  int at = -1;
  for (int i = 0; i < set.n; i++) {
    const Vec3 apart = set.distance[i] * set.normal[i] - closest.distance * closest.normal;
    if (norm_sq(apart) > kSamePoint * kSamePoint * tolerance * tolerance) continue;
    const Real held = at < 0 ? closest.distance : set.distance[at];
    const FeatureCode holder = at < 0 ? feature : set.feature[at];
    const bool better =
        set.distance[i] < held || (set.distance[i] == held && set.feature[i] < holder);
    if (at < 0) {
      at = i;
      if (better) continue;
      set.feature[i] = feature;
      set.normal[i] = closest.normal;
      set.distance[i] = closest.distance;
    } else {
      if (better) {
        set.feature[at] = set.feature[i];
        set.normal[at] = set.normal[i];
        set.distance[at] = set.distance[i];
      }
      set.remove(i--);
    }
  }
  if (at < 0) set.add(feature, closest.normal, closest.distance);
}

// Adds the contact of a feature, if it has one. `copy`: a copy of its record, or null.
template <int kMost>
LSDCD_FN void add_feature(const MeshGeometry &geometry, FeatureCode feature, Real radius,
                          ContactSet<kMost> &set, const FeatureRecord *copy = nullptr)
{
  const ClosestPoint closest = geometry.closest_point(feature, radius, copy);
  if (closest.found && closest.distance < radius)
    add_once(set, feature, closest, geometry.tolerance());
}

// Does what add_feature() does, as a function of its own, for searches that few spheres need: the tests of features are
// long, and would be compiled into each law's kernels many times.
template <int kMost>
LSDCD_NOINLINE void add_feature_noinline(const MeshGeometry &geometry, FeatureCode feature,
                                         Real radius, ContactSet<kMost> &set,
                                         const FeatureRecord *copy = nullptr)
{
  add_feature(geometry, feature, radius, set, copy);
}

// The contacts of a face and its edges and vertices. Over the inside of a face only the face is near.
template <int kMost>
LSDCD_NOINLINE void add_primitive(const MeshGeometry &geometry, FeatureCode primitive, Real radius,
                                  ContactSet<kMost> &set)
{
  if (feature_kind(primitive) == FeatureKind::face) {
    const FaceRegion over = geometry.over(primitive, radius);
    if (over == FaceRegion::far) return;
    if (over != FaceRegion::inside)
      for (FeatureCode part : geometry.parts(primitive).part)
        if (part != kNoFeature) add_feature_noinline(geometry, part, radius, set);
    if (over == FaceRegion::outside) return;
  }
  add_feature_noinline(geometry, primitive, radius, set);
}

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
  // The list is sorted by distance from the cell's centre: no feature past this bound can be
  // within the radius.
  const Entries entries(grid.lists);
  const typename Entries::Limit enough = entries.limit(radius + norm(at.from_centre));
  for (std::uint32_t i = cell.first; i < cell.first + cell.count; i++) {
    const typename Entries::Entry entry = entries[i];
    if (!entries.is_within(entry, enough)) break;
    add_feature_noinline(geometry, entries.feature(entry), radius, set);
    if (set.overflow) break;    // nothing else is valid
  }
}

// Returns the radius up to which the set is known to be complete.
template <int kMost>
LSDCD_FN Real find_in_nearest(const GridView &grid, const Vec3 &q, Real radius,
                              ContactSet<kMost> &set)
{
  CellAddress at;
  Cell cell;
  if (!find_cell(grid, q, at, cell)) return kAnyDistance;
  const MeshGeometry geometry(grid, q);
  if (cell.count == 1) {
    add_primitive(geometry, cell.first, radius, set);
    return kAnyDistance;
  }
  const Real off_centre = norm(at.from_centre);
  for (std::uint32_t k = 0; k < cell.count; k++) {
    const CellEntry entry = grid.lists.entries[cell.first + k];
    if (entry.bound > radius + off_centre) break;
    // The tolerance covers the rounding of distances.
    if (k == grid.list_kind.most()) return entry.bound - off_centre - grid.tolerance;
    add_primitive(geometry, entry.feature, radius, set);
    if (set.overflow) break;
  }
  return kAnyDistance;
}

// Finds the local minima of the distance from q to the wall that are below `radius` (length, at
// most grid.cutoff). With complete lists it finds all, with nearest lists those on the listed
// primitives. Returns the radius up to which none can be missing.
// Entries: the form of the grid's complete lists.
template <class Entries, int kMost>
LSDCD_FN Real find_contacts_in(const GridView &grid, const Vec3 &q, Real radius,
                               ContactSet<kMost> &set)
{
  if (grid.list_kind.has_primitives()) return find_in_nearest(grid, q, radius, set);
  find_in_complete<Entries>(grid, q, radius, set);
  return kAnyDistance;
}

// Finds the contacts in any grid, also one for queries, whose lists are full.
template <int kMost>
LSDCD_FN Real find_contacts(const GridView &grid, const Vec3 &q, Real radius,
                            ContactSet<kMost> &set)
{
  if (!grid.lists.is_packed()) return find_contacts_in<FullEntries>(grid, q, radius, set);
  return find_contacts_in<PackedEntries>(grid, q, radius, set);
}

// Returns the outward pseudonormal of a feature: its dot product with (q - closest point) tells on which side of a closed
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

// Keeps spheres on one side of a closed wall: sign +1 outside, -1 inside. The closest
// point tells on which side the centre is. If that is the right side, contacts with the
// wall's far face are dropped. Else the nearest contact is reversed: with the overlap
// radius + distance it pushes the sphere back.
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
