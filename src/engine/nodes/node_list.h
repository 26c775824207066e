// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Neighbour lists of spheres at a mesh whose nodes move. A list names whole primitives, which are faces with their edges
// and vertices, by their distance alone. A primitive at a distance d now is at least d - (way of the sphere) - (way of the
// nodes) away later, however its normal turns. So a list of all primitives within
//   cutoff + margin of the list + NodeField::going
// is complete while the sphere is within the margin and no node has moved farther than `going`; then the host searches for
// candidates again, which makes all lists anew.
#pragma once

#include "contact/node_field.h"
#include "contact/primitive_contacts.h"
#include "engine/lists/feature_list.h"
#include "geometry/primitive_distance.h"

namespace lsdcd {

// Makes a list of primitives from those of a cell, one after the other. The list is valid for a way that is a share of the sphere's
// radius; the way is reduced as soon as the list is too short for what is near on that way.
class NodeListMaker {
 public:
  LSDCD_FN NodeListMaker(const GridView &grid, const QuerySphere &s, Real going,
                         FeatureList &list) :
      list_(list),
      beside_margin_(going + grid.tolerance), cutoff_((1 + Real(2e-6)) * s.cutoff)
  {
    begin_list(list, s.x, s.cutoff, kSkinFraction * s.radius);
  }

  // Returns the distance within which primitives belong to the list. FeatureLists::put() says how long lists are valid.
  LSDCD_FN Real within() const { return cutoff_ + list_.margin + beside_margin_; }

  // Adds a primitive at this distance if it belongs to the list. Returns false if no list can be made, however short the way.
  LSDCD_FN bool add(FeatureCode code, Real distance)
  {
    int at = list_.n;
    while (at > 0 && list_.code[at - 1] > code) at--;
    if (at > 0 && list_.code[at - 1] == code) return true;
    while (list_.n == FeatureList::kMax && distance <= within())
      if (!shorten()) return false;
    if (!(distance <= within())) return true;
    at = list_.n++;
    for (; at > 0 && list_.code[at - 1] > code; at--) {
      list_.code[at] = list_.code[at - 1];
      distance_[at] = distance_[at - 1];
    }
    list_.code[at] = code;
    distance_[at] = distance;
    return true;
  }

 private:
  LSDCD_FN bool shorten()
  {
    if (shrinks_++ == kMaxShrinks) {
      begin_list(list_, list_.x, list_.cutoff, -1);
      return false;
    }
    list_.margin /= kShrink;
    const Real now = within();
    int n = 0;
    for (int i = 0; i < list_.n; i++) {
      if (!(distance_[i] <= now)) continue;
      list_.code[n] = list_.code[i];
      distance_[n++] = distance_[i];
    }
    list_.n = n;
    return true;
  }

  FeatureList &list_;
  Real distance_[FeatureList::kMax];    // of the listed primitives
  const Real beside_margin_, cutoff_;
  int shrinks_ = 0;
};

// Returns whether the primitive is within this distance of q, and gives its distance if it is.
LSDCD_FN bool is_primitive_within(const GridView &grid, FeatureCode code, const Vec3 &q,
                                  Real within, Real &distance)
{
  if (feature_kind(code) == FeatureKind::face &&
      OverFace(grid.wall.faces[feature_index(code)], q).is_past(within))
    return false;
  distance = primitive_distance(grid.wall, code, q);
  return distance <= within;
}

// Makes the list of a sphere from its cell, which lists what is near. Each thread of a warp has a sphere, or none if it is not
// `mine`; the threads share the entries of their cells.
template <unsigned kSize>
LSDCD_FN void gather_nodes(const Warp<kSize> &warp, bool mine, const GridView &grid,
                           const QuerySphere &s, Real going, FeatureList &list)
{
  NodeListMaker made(grid, s, going, list);
  CellAddress in_cell = {};
  Cell cell = {};
  std::uint32_t at = 0, end = 0;    // the entries of the cell that are left
  if (mine && find_cell(grid, s.x, in_cell, cell)) end = cell.count;
  const Real away = norm(in_cell.from_centre);
  for (unsigned busy = warp.vote(at < end); busy != 0; busy = warp.vote(at < end)) {
    const WorkSplit<kSize> split(warp, busy);
    const Vec3 q = warp.of(s.x, split.owner);
    const Real within = warp.of(made.within(), split.owner),
               enough = within + warp.of(away, split.owner);
    const std::uint32_t first = warp.of(cell.first, split.owner),
                        count = warp.of(cell.count, split.owner),
                        its_end = warp.of(end, split.owner),
                        c = warp.of(at, split.owner) + split.turn;
    // A cell has a single entry inline. Several entries ascend in their bounds on the distance from its centre.
    bool near = split.helps && c < its_end;
    CellEntry entry = {first, 0};
    if (near && count > 1) entry = grid.lists.entries[first + c];
    near = near && !(entry.bound > enough);
    Real distance = 0;
    unsigned hits =
        warp.vote(near && is_primitive_within(grid, entry.feature, q, within, distance)) &
        split.own;
    const bool all_near = (warp.vote(near) & split.own) == split.own;
    if (at < end) at = all_near ? at + split.size : end;
    for (; warp.vote(hits != 0); hits &= hits - 1) {
      const unsigned from = warp.first(hits);
      const FeatureCode code = warp.of(entry.feature, from);
      const Real its_distance = warp.of(distance, from);
      if (hits == 0 || made.add(code, its_distance)) continue;
      at = end;
      hits = 0;
    }
  }
}

// Prefetches, on a CPU, the records of the first faces of a list whose turn comes soon.
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

// Finds the local minima of the distance from q to the listed primitives, as add_primitive() does. If q is over the inside of a
// face, the sides of that face are not tested again for its neighbours.
template <int kCapacity>
LSDCD_FN void find_in_node_list(const GridView &grid, const ListedFeatures &list, const Vec3 &q,
                                Real cutoff, ContactSet<kCapacity> &set)
{
  constexpr std::size_t kAhead = 6;
  prefetch_node_list(grid, list.lists, list.k + kAhead);
  FeatureCode rim[FeatureList::kMax], inside = kNoFeature;
  unsigned in_reach[FeatureList::kMax];
  int n_rim = 0;
  const int n = list.lists.size(list.k);
  for (int i = 0; i < n; i++) {
    const FeatureCode code = list.lists.code(list.k, i);
    if (feature_kind(code) != FeatureKind::face) {
      add_feature_noinline(MeshGeometry(grid, q), code, cutoff, set);
      continue;
    }
    rim[n_rim] = code;
    in_reach[n_rim] = add_inside(grid, code, q, cutoff, inside, set);
    n_rim += in_reach[n_rim] != 0;
  }
  for (int i = 0; i < n_rim && !set.overflow; i++)
    add_rim(grid, rim[i], in_reach[i], inside, q, cutoff, set);
}

}    // namespace lsdcd
