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

// A list of primitives that is made from those of a cell, one after the other. It is for a way of a share of the sphere's
// radius, or for less, as soon as it has no room for what is near on that way.
class NodeListMaker {
 public:
  LSDCD_FN NodeListMaker(const GridView &grid, const QuerySphere &s, Real going,
                         FeatureList &list) :
      list_(list),
      beside_margin_(going + grid.tolerance), cutoff_((1 + Real(2e-6)) * s.cutoff)
  {
    begin_list(list, s.x, s.cutoff, kSkinFraction * s.radius);
  }

  // Returns the distance of primitives that belong to it. Lists hold as long as FeatureLists::put() says.
  LSDCD_FN Real within() const { return cutoff_ + list_.margin + beside_margin_; }

  // Adds a primitive at this distance where it belongs. Returns false where there is no list for any way.
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
  Real distance_[FeatureList::kMax];    // of what is listed
  const Real beside_margin_, cutoff_;
  int shrinks_ = 0;
};

// Is the primitive within this distance of q? Gives its distance where it is.
LSDCD_FN bool is_primitive_within(const GridView &grid, FeatureCode code, const Vec3 &q,
                                  Real within, Real &distance)
{
  if (feature_kind(code) == FeatureKind::face &&
      OverFace(grid.wall.faces[feature_index(code)], q).is_past(within))
    return false;
  distance = primitive_distance(grid.wall, code, q);
  return distance <= within;
}

// Makes the list of a sphere from its cell, which lists what is near. Each thread of a warp has a sphere, or none where it
// is not `mine`; the threads share the entries of their cells.
template <unsigned kSize>
LSDCD_FN void gather_nodes(const Warp<kSize> &warp, bool mine, const GridView &grid,
                           const QuerySphere &s, Real going, FeatureList &list)
{
  NodeListMaker made(grid, s, going, list);
  CellAddress in_cell = {};
  Cell cell = {};
  std::uint32_t at = 0, end = 0;    // of the cell's entries those that are left
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
    // A cell has a single entry inline. Others ascend in their bounds on the distance from its centre.
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

// What of a face at whose rim or past which q is can have a contact, by the point over the face alone: bit k is edge k, bit
// 3 + k vertex k, bit 6 the face. A vertex is at least as far as the lines of its two edges. An edge has a contact only where q is
// past its side and between its ends, a vertex only where q is behind it along both edges; some tolerances cover the
// rounding between these tests and those of closest_point.h.
LSDCD_FN unsigned parts_in_reach(const FaceRecord &face, const OverFace &over, Real cutoff,
                                 Real tolerance)
{
  const Real within = cutoff + tolerance, some = 4 * tolerance,
             beside_sq = (1 + Real(1e-9)) * (within * within) - over.height * over.height;
  bool is_near[3], before[3], behind[3], is_at[3];
  for (int k = 0; k < 3; k++) {
    const int last = (k + 2) % 3;    // the edge that ends at vertex k, where edge k begins
    const Real c = dot(face.inward[k], face.inward[last]),
               // How far q is from vertex k along these edges, times the sine of their angle.
        along = over.side[last] - c * over.side[k], along_last = over.side[k] - c * over.side[last];
    is_near[k] = over.side[k] * over.side[k] <= beside_sq;
    before[k] = along < -some;
    behind[last] = along_last < -some;
    is_at[k] = along <= some && along_last <= some;
  }
  unsigned parts = over.least >= -tolerance ? 64 : 0;
  for (int k = 0; k < 3; k++) {
    const bool edge = over.side[k] <= 2 * tolerance && !before[k] && !behind[k],
               vertex = is_near[k] && is_near[(k + 2) % 3] && is_at[k];
    parts |= static_cast<unsigned>(edge) << k | static_cast<unsigned>(vertex) << (3 + k);
  }
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
      in_reach[n_rim] = parts_in_reach(face, over, cutoff, grid.tolerance);
      n_rim += in_reach[n_rim] != 0;
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
