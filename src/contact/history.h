// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How the contacts of a step take over the springs of the last step.
#pragma once

#include "contact/contact_set.h"
#include "contact/spring.h"
#include "geometry/wall_records.h"

namespace lsdcd {

// Rotates a tangent vector by the smallest rotation that takes the unit vector `from` to `to`, which is not near its
// opposite: transfer_of() hands nothing on there. The length stays. On a face the normals of two steps are equal.
LSDCD_FN Vec3 transport(const Vec3 &h, const Vec3 &from, const Vec3 &to)
{
  if (from == to) return h;
  const Vec3 axis = cross(from, to);
  const Vec3 turned = cross(axis, h);
  return h + turned + (1 / (1 + dot(from, to))) * cross(axis, turned);
}

// Number of vertices of a feature, and the vertices.
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

// Do two features share a vertex? A feature and its periodic image share all of theirs: a sphere that
// is wrapped into the box leaves one for the other.
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

// Cosine above which a contact that changed features is still the same contact.
constexpr Real kMoved = 0.7;

// Is spring k of the last step on the mesh that is looked at? If the wall has one mesh, all are.
LSDCD_FN bool is_own(const Spring *, int)
{
  return true;
}
// Returns a vector that belongs to spring k, in the frame of that mesh.
LSDCD_FN Vec3 in_own_frame(const Spring *, int, const Vec3 &h)
{
  return h;
}

// Cosine above which two contacts lie in the same direction: 1.4e-3 radians, more than rounding or one step
// turns a normal.
constexpr Real kSameDirection = 1 - 1e-6;

// What of two contacts of a sphere is compared: their normals. Of other grains it is more (grain_contacts.h).
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

// Does none of these contacts go on with old spring k, whose direction was `was`? One does if it is on its feature, or if it
// carries it on: it lies in its direction, where the contact that asks does not (`carries`).
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

// Was the contact of old spring k left, as contact i sees it? It was not if its feature is still in contact, or if
// another contact carries it on: one in its direction, where contact i is not. There the sphere crossed a line that
// cuts a face or an edge in two, and without that cut it would have left nothing.
template <class Set, class Springs>
LSDCD_FN bool is_left(const Set &set, int i, const Springs &old, int k)
{
  const auto &was = old_direction(old, k);
  return is_left_by(set, dot(direction_of(set, i), was) > kSameDirection, was, old, k);
}

// As transport(), also where a feature may have turned its normal round since, as by nodes that go far in one step: nothing is
// left then.
LSDCD_FN Vec3 transport_unless_turned_round(const Vec3 &h, const Vec3 &from, const Vec3 &to)
{
  return dot(from, to) > -kMoved ? transport(h, from, to) : Vec3{0, 0, 0};
}

// The spring of the last step that a contact begins with, and the share of it.
struct Transfer {
  int from;     // index of the old spring; -1: a new one
  Real part;    // 0 to 1
};

// How much contact i of a sphere is like old spring k, of which the normals have this cosine.
template <class Springs>
LSDCD_FN Real likeness_to_old(const ContactsView &, int, const Springs &, int, Real of_normals)
{
  return of_normals;
}

// 1. The spring of the same feature, unless the normal has turned round.
// 2. Else one whose contact was left this step, nearly aligned and, of a sphere, next to this one:
//    the contact moved across a seam, the spring goes with it, whole. A contact with arms may jump over
//    many triangles in one step, as under a flat side: of several it takes over the most alike one.
// 3. Else the most alike spring times its likeness, of spheres max(0, n.n): a contact born beside
//    others takes over as much of their force as it will carry in their stead. Where n.n is not above 0 that
//    is nothing, also of two contacts with arms that turn the grain alike, as between opposite walls.
// Springs of other meshes hand over by 3 alone, as their features are not this wall's.
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

// Returns a vector of the old spring `in.from` after the contact with this unit normal has taken it over.
template <class Springs>
LSDCD_FN Vec3 handed_on(const Vec3 &h, const Transfer &in, const Springs &old, const Vec3 &normal)
{
  return in.part * transport(h, old[in.from].normal, normal);
}

// Does adhesion hold the sphere at contact i, which does not overlap? Adhesion begins where they overlap. It goes
// on if in the last step the same contact held the sphere, or one with nearly the same normal on an adjacent feature
// or on another mesh: adhesion crosses seams. `shares`: contacts share their overlap, so that a contact may begin
// while the last one lasts; else it begins where the last one has ended.
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
