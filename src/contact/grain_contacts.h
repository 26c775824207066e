// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of a grain that is no sphere: how alike two of them are, and how they take over the springs of the last step. How
// they share is in grain_rule.h.
//
// Where spheres compare normals to hand on springs, such a grain compares what unit impulses at its contacts do to it. The cosine
// of two contacts is that of (n, r x n), with r from the centre to the grain's point, in the metric of inverse mass and inertia:
// two contacts with one normal at the two ends of a rod are not alike. Of a sphere it is the cosine of the normals.
#pragma once

#include "contact/history.h"
#include "shape/superellipsoid.h"

#include <cmath>
#include <cstddef>

namespace lsdcd {

// A unit vector of six numbers: a normal, and the turning of the grain by an impulse along it.
struct GrainDirection {
  Vec3 normal, turning;
};
inline Real dot(const GrainDirection &a, const GrainDirection &b)
{
  return dot(a.normal, b.normal) + dot(a.turning, b.turning);
}
inline Real norm_sq(const GrainDirection &a)
{
  return dot(a, a);
}
inline GrainDirection operator-(const GrainDirection &a, const GrainDirection &b)
{
  return {a.normal - b.normal, a.turning - b.turning};
}

// The metric of a grain's mass and inertia, in the frame of a mesh.
struct GrainMetric {
  Vec3 row[3];    // rows of the matrix that turns its axes to the frame
  Vec3 scale;     // sqrt(mass / inertia) about its axes, 1/length

  Vec3 turned(const Vec3 &v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Vec3 to_own(const Vec3 &v) const { return v.x * row[0] + v.y * row[1] + v.z * row[2]; }
  // Returns the direction of a contact with this unit normal and this arm, from the centre.
  GrainDirection direction(const Vec3 &normal, const Vec3 &arm) const
  {
    const Vec3 t = to_own(cross(arm, normal));
    const Vec3 turning = {scale.x * t.x, scale.y * t.y, scale.z * t.z};
    const Real size = std::sqrt(1 + norm_sq(turning));
    return {(1 / size) * normal, (1 / size) * turning};
  }
};

// In the frame of its mesh.
struct GrainContact {
  FeatureCode feature;
  Vec3 normal;     // unit, wall -> grain
  Real overlap;    // length, > 0
  Vec3 arm;        // from the centre to the grain's point
  Vec3 foot;       // on the wall
  GrainDirection direction;
  const GrainMetric *metric;    // of the grain in that frame
  Vec3 couple = {0, 0, 0};      // torque on the grain that is not by the force at this contact
  // How deep it may be for a force that does not jump where it ends: the radius of curvature of the grain's shadow across the fold
  // or edge; length.
  Real limit = HUGE_VAL;
};

struct GrainContactsView {
  int n;
  const GrainContact *at;
  const Superellipsoid *shape;
  std::size_t grain;    // its index

  GrainContactsView part(int from, int n_of_part) const
  {
    return {n_of_part, at + from, shape, grain};
  }
};

// The springs of the last step, as one mesh sees them: each has an arm beside its shear displacement.
template <class Springs>
struct OldGrainContacts {
  const Springs &springs;
  const Real *
      extra;    // n_extra for each spring, of which the first three are the arm in the frame of the spring's mesh
  int n_extra, n;
  const GrainMetric &metric;

  Vec3 arm(int k) const
  {
    const Real *at = extra + k * n_extra;
    return in_own_frame(springs, k, {at[0], at[1], at[2]});
  }
  GrainDirection direction(int k) const { return metric.direction(springs[k].normal, arm(k)); }
};

// Was the contact of old spring k left, as contact i sees it? As is_left() of spheres.
template <class Springs>
bool is_left(const GrainContactsView &set, int i, const OldGrainContacts<Springs> &old, int k)
{
  const GrainDirection was = old.direction(k);
  const bool carries = dot(set.at[i].direction, was) > kSameDirection;
  for (int j = 0; j < set.n; j++)
    if ((is_own(old.springs, k) && set.at[j].feature == old.springs[k].feature) ||
        (!carries && dot(set.at[j].direction, was) > kSameDirection))
      return false;
  return true;
}

// Returns which old spring contact i goes on with, as for spheres but for two things. A contact that has moved need not be next
// to where it was: under a flat side it may jump over many triangles in one step. And of several springs that were left it takes
// over the most alike one.
template <class Springs>
Transfer transfer_of(const GrainContactsView &set, int i, const OldGrainContacts<Springs> &old)
{
  const GrainContact &now = set.at[i];
  int best = -1, moved = -1;
  Real best_cos = 0, moved_cos = -1;
  for (int k = 0; k < old.n; k++) {
    const Real of_normals = dot(old.springs[k].normal, now.normal);
    const bool own = is_own(old.springs, k);
    if (own && old.springs[k].feature == now.feature) return {of_normals > -kMoved ? k : -1, 1};
    const Real c = dot(old.direction(k), now.direction);
    if (c > best_cos) {
      best_cos = c;
      best = k;
    }
    if (own && of_normals > kMoved && c > moved_cos && is_left(set, i, old, k)) {
      moved_cos = c;
      moved = k;
    }
  }
  if (moved >= 0) return {moved, 1};
  return {best, best_cos > 1 ? 1 : best_cos};
}

}    // namespace lsdcd
