// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Transfers the springs of the last step to the contacts of this step.
#pragma once

#include "contact/contact_set.h"
#include "contact/spring.h"
#include "geometry/wall_records.h"

namespace lsdcd {

// Rotates a tangent vector by the smallest rotation that takes the unit vector `from` to `to`, and keeps its length. `to` must
// not be nearly opposite to `from`: transfer_of() transfers no spring there. On a face the normals of two steps are equal.
LSDCD_FN Vec3 transport(const Vec3 &h, const Vec3 &from, const Vec3 &to)
{
  if (from == to) return h;
  const Vec3 axis = cross(from, to);
  const Vec3 turned = cross(axis, h);
  return h + turned + (1 / (1 + dot(from, to))) * cross(axis, turned);
}

// Returns the number of vertices of a feature, and writes the vertices to v.
LSDCD_FN int feature_vertices(const MeshFeaturesView &wall, FeatureCode feature, std::int32_t *v)
{
  const std::uint32_t i = feature_index(feature);
  switch (feature_kind(feature)) {
    case FeatureKind::face:
      for (int k = 0; k < 3; k++) v[k] = wall.face_vertex[i].v[k];
      return 3;
    case FeatureKind::edge:
      for (int k = 0; k < 2; k++) v[k] = wall.edge_vertex[i].v[k];
      return 2;
    default:
      v[0] = static_cast<std::int32_t>(i);
      return 1;
  }
}

// Returns whether two features share a vertex. A feature and its periodic image share all of theirs: a sphere that is wrapped
// into the box leaves one for the other.
LSDCD_FN bool are_adjacent(const MeshFeaturesView &wall, FeatureCode a, FeatureCode b)
{
  std::int32_t va[3], vb[3];
  const int na = feature_vertices(wall, a, va), nb = feature_vertices(wall, b, vb);
  if (wall.images.same_vertex) {
    for (int i = 0; i < na; i++) va[i] = wall.images.same_vertex[va[i]];
    for (int j = 0; j < nb; j++) vb[j] = wall.images.same_vertex[vb[j]];
  }
  for (int i = 0; i < na; i++)
    for (int j = 0; j < nb; j++)
      if (va[i] == vb[j]) return true;
  return false;
}

// Cosine above which a contact that has changed its feature is still the same contact.
constexpr Real kMoved = 0.7;

// Returns whether spring k of the last step is on the mesh of these contacts. True for all springs if the wall has one mesh.
LSDCD_FN bool is_own(const Spring *, int)
{
  return true;
}
// Returns a vector of spring k in the frame of the mesh of these contacts.
LSDCD_FN Vec3 in_own_frame(const Spring *, int, const Vec3 &h)
{
  return h;
}

// Cosine above which two contacts have the same direction: 1.4e-3 radians, which is more than rounding or one step turns a
// normal.
constexpr Real kSameDirection = 1 - 1e-6;

// Returns the direction by which two contacts are compared. For spheres it is the normal; for other grains it has more numbers
// (grain_contacts.h).
LSDCD_FN const Vec3 &direction_of(const ContactsView &set, int i)
{
  return set.normal[i];
}
LSDCD_FN const Vec3 &old_direction(const Spring *old, int k)
{
  return old[k].normal;
}
template <class Springs>
LSDCD_FN Vec3 old_direction(const Springs &old, int k)
{
  return old[k].normal;
}

// Returns whether none of these contacts continues old spring k, whose direction was `was`. A contact continues it if it is on
// the same feature, or if it has the direction of the spring while the contact that asks does not (`carries`: it does).
template <class Set, class Direction, class Springs>
LSDCD_FN bool is_left_by(const Set &set, bool carries, const Direction &was, const Springs &old,
                         int k)
{
  for (int j = 0; j < set.n; j++)
    if ((is_own(old, k) && set.feature[j] == old[k].feature) ||
        (!carries && dot(direction_of(set, j), was) > kSameDirection))
      return false;
  return true;
}

// Returns whether the contact of old spring k has ended, as contact i sees it. It has not if its feature is still in contact,
// or if another contact continues it: one with its direction, while contact i has another direction. In that case the sphere
// has crossed a line that cuts a face or an edge in two, and without that cut no contact would have ended.
template <class Set, class Springs>
LSDCD_FN bool is_left(const Set &set, int i, const Springs &old, int k)
{
  const auto &was = old_direction(old, k);
  return is_left_by(set, dot(direction_of(set, i), was) > kSameDirection, was, old, k);
}

// Does the same as transport(), but also if a feature may have reversed its normal since, as when nodes move far in one step:
// the result is then 0.
LSDCD_FN Vec3 transport_unless_turned_round(const Vec3 &h, const Vec3 &from, const Vec3 &to)
{
  return dot(from, to) > -kMoved ? transport(h, from, to) : Vec3{0, 0, 0};
}

// The spring of the last step with which a contact begins, and the share of it that it gets.
struct Transfer {
  int from;     // index of the old spring; -1: a new one
  Real part;    // 0 to 1
};

// Returns how alike contact i of a sphere and old spring k are, whose normals have this cosine.
template <class Springs>
LSDCD_FN Real likeness_to_old(const ContactsView &, int, const Springs &, int, Real of_normals)
{
  return of_normals;
}

// 1. The spring of the same feature, unless the normal has turned round.
// 2. Otherwise a spring whose contact has ended in this step, which is nearly aligned and, for a sphere, next to
//    this contact: the contact has moved across a seam, and the whole spring moves with it. A contact with arms may
//    jump over many triangles in one step, as under a flat side: of several springs it takes over the most alike one.
// 3. Otherwise the most alike spring times its likeness, which is max(0, n.n) for spheres: a contact that begins
//    beside others takes over that part of their force which it will bear in their place. If n.n is not above 0, that
//    is nothing, even for two contacts with arms that turn the grain alike, as between opposite walls.
// Springs of other meshes are transferred by rule 3 alone, because their features are not those of this wall.
template <class Set, class Springs>
LSDCD_FN Transfer transfer_of(const MeshFeaturesView &wall, const Set &set, int i,
                              const Springs &old, int n_old)
{
  int best = -1, moved = -1;
  Real best_cos = 0, moved_cos = Set::kHasArms ? -1 : kMoved;
  for (int k = 0; k < n_old; k++) {
    const Real of_normals = dot(old[k].normal, set.normal[i]);
    const bool own = is_own(old, k);
    if (own && old[k].feature == set.feature[i]) return {of_normals > -kMoved ? k : -1, 1};
    const Real c = likeness_to_old(set, i, old, k, of_normals);
    if (c > best_cos && (!Set::kHasArms || of_normals > 0)) {    // a sphere's c is of_normals
      best_cos = c;
      best = k;
    }
    if (own && c > moved_cos &&
        (Set::kHasArms ? of_normals > kMoved
                       : are_adjacent(wall, old[k].feature, set.feature[i])) &&
        is_left(set, i, old, k)) {
      moved_cos = c;
      moved = k;
    }
  }
  if (moved >= 0) return {moved, 1};
  return {best, best_cos};
}

// Returns a vector of old spring `in.from` after the contact with this unit normal has taken the spring over.
template <class Springs>
LSDCD_FN Vec3 handed_on(const Vec3 &h, const Transfer &in, const Springs &old, const Vec3 &normal)
{
  return in.part * transport(h, old[in.from].normal, normal);
}

// Returns whether adhesion holds the sphere at contact i, which does not overlap. Adhesion begins with an overlap. It
// continues if in the last step the same contact held the sphere, or one with nearly the same normal on an adjacent feature or
// on another mesh: adhesion crosses seams. `shares`: contacts share their overlap, so that a contact may begin while the
// previous one lasts; otherwise it begins where the previous one has ended.
template <class Springs>
LSDCD_FN bool is_held(const MeshFeaturesView &wall, const ContactsView &set, int i, bool shares,
                      const Springs &old, int n_old)
{
  for (int k = 0; k < n_old; k++) {
    if (!(dot(old[k].normal, set.normal[i]) > kMoved)) continue;
    if (!is_own(old, k) || old[k].feature == set.feature[i]) return true;
    if (are_adjacent(wall, old[k].feature, set.feature[i]) && (shares || is_left(set, i, old, k)))
      return true;
  }
  return false;
}

}    // namespace lsdcd
