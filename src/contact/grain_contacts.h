// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of a grain that is no sphere: how alike two of them are, and how they take over the springs of the last step.
// grain_rule.h has the rule by which they share.
//
// When springs are transferred, contacts of spheres are compared by their normals. Contacts of other grains are compared by what
// unit impulses at them do to the grain. The cosine of two contacts is that of their vectors (n, r x n), with r from the centre
// to the grain's point, in the metric of inverse mass and inertia. So two contacts with the same normal at the two ends of a rod
// are not alike. For a sphere it is the cosine of the normals.
#pragma once

#include "contact/history.h"
#include "shape/superellipsoid.h"

#include <cmath>
#include <cstddef>

namespace lsdcd {

// A unit vector of six numbers: a normal, and the rotation of the grain by an impulse along it.
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
  // Returns the direction of a contact with this unit normal and this arm (from the centre).
  GrainDirection direction(const Vec3 &normal, const Vec3 &arm) const
  {
    const Vec3 t = to_own(cross(arm, normal));
    const Vec3 turning = {scale.x * t.x, scale.y * t.y, scale.z * t.z};
    const Real size = std::sqrt(1 + norm_sq(turning));
    return {(1 / size) * normal, (1 / size) * turning};
  }
};

// A contact of a grain that is no sphere, as a step uses it: a FoundGrainContact in the frame of its mesh, with what springs and couples
// need in addition.
struct GrainContact {
  FeatureCode feature;
  Vec3 normal;     // unit, wall -> grain
  Real overlap;    // length, > 0
  Vec3 arm;        // from the centre to the grain's point
  Vec3 foot;       // on the wall
  GrainDirection direction;
  const GrainMetric *metric;    // of the grain in that frame
  Vec3 couple = {0, 0, 0};      // torque on the grain that the force at this contact does not cause
};

// A borrowed view of the contacts of a grain that is no sphere, with the functions that a step needs.
struct GrainContactsView {
  // A view of one member of each contact.
  template <class T>
  struct Member {
    const GrainContact *at;
    T GrainContact::*member;

    const T &operator[](int i) const { return at[i].*member; }
  };

  static constexpr bool kHasArms = true;
  int n;
  const GrainContact *at;
  const Superellipsoid *shape;
  Member<FeatureCode> feature = {at, &GrainContact::feature};
  Member<Vec3> normal = {at, &GrainContact::normal};

  GrainContactsView part(int from, int n_of_part) const { return {n_of_part, at + from, shape}; }
  Real overlap_of(int i, Real) const { return at[i].overlap; }
  const Vec3 &foot_of(int i, const Vec3 &, const Vec3 &) const { return at[i].foot; }
};
inline const GrainDirection &direction_of(const GrainContactsView &set, int i)
{
  return set.at[i].direction;
}

// The springs of the last step in the frame of one mesh. Each has an arm in addition to its shear displacement.
template <class Springs>
struct OldGrainContacts {
  const Springs &springs;
  const Real *
      extra;    // n_extra for each spring; the first three are the arm in the frame of the spring's mesh
  int n_extra;
  const GrainMetric &metric;

  decltype(auto) operator[](int k) const { return springs[k]; }
  Vec3 arm(int k) const
  {
    const Real *at = extra + k * n_extra;
    return in_own_frame(springs, k, {at[0], at[1], at[2]});
  }
};
template <class Springs>
bool is_own(const OldGrainContacts<Springs> &old, int k)
{
  return is_own(old.springs, k);
}
template <class Springs>
GrainDirection old_direction(const OldGrainContacts<Springs> &old, int k)
{
  return old.metric.direction(old[k].normal, old.arm(k));
}

template <class Springs>
Real likeness_to_old(const GrainContactsView &set, int i, const OldGrainContacts<Springs> &old,
                     int k, Real)
{
  return dot(old_direction(old, k), set.at[i].direction);
}

}    // namespace lsdcd
