// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of a sphere on one feature, and on one primitive of a mesh: a face with its edges and vertices.
#pragma once

#include "contact/contact_set.h"
#include "contact/mesh_geometry.h"

namespace lsdcd {

// Because of the tolerance two features may both have a contact at a seam. Their closest points are then at most this many tolerances
// apart, as each is off by at most two.
constexpr Real kSamePoint = 4;

// Returns whether two closest points with this difference belong to one contact. Lengths.
LSDCD_FN bool is_same_point(const Vec3 &apart, Real tolerance)
{
  return !(norm_sq(apart) > kSamePoint * kSamePoint * tolerance * tolerance);
}

// Adds a contact unless the set already has one at the same point of the wall. In that case the nearer one stays, or at equal distances
// the one on the lower feature, whatever the order. A closest point between two others merges all three.
template <int kMost>
LSDCD_FN void add_once(ContactSet<kMost> &set, FeatureCode feature, const ClosestPoint &closest,
                       Real tolerance)
{
  int at = -1;
  for (int i = 0; i < set.n; i++) {
    const Vec3 apart = set.distance[i] * set.normal[i] - closest.distance * closest.normal;
    if (!is_same_point(apart, tolerance)) continue;
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

// Does the same as add_feature(), as a function of its own, for searches that few spheres need: the tests of features are long, and would
// otherwise be compiled many times into the kernels of each law.
template <int kMost>
LSDCD_NOINLINE void add_feature_noinline(const MeshGeometry &geometry, FeatureCode feature,
                                         Real radius, ContactSet<kMost> &set,
                                         const FeatureRecord *copy = nullptr)
{
  add_feature(geometry, feature, radius, set, copy);
}

// The position of a point over a face.
struct OverFace {
  Real height, side[3];    // signed distances from the plane and the sides of the face
  Real least;              // the least of the distances from its sides

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
  // Returns whether the face is surely farther away than `within`. Past a side its distance is at least that in the plane of height and
  // side. The factor covers rounding.
  LSDCD_FN bool is_past(Real within) const
  {
    const Real past = least < 0 ? least : 0;
    return height * height + past * past > (1 + Real(1e-9)) * (within * within);
  }
};

// Returns which parts of a face can have a contact, for a point q at its rim or past it, from OverFace alone: bit k is edge k, bit 3 + k
// vertex k, bit 6 the face. A vertex is at least as far away as the lines of its two edges. An edge has a contact only if q is past its
// side and between its ends, and a vertex only if q is behind it along both edges. A few tolerances cover the rounding between these
// tests and those of closest_point.h.
LSDCD_FN unsigned parts_in_reach(const FaceRecord &face, const OverFace &over, Real cutoff,
                                 Real tolerance)
{
  const Real within = cutoff + tolerance, some = 4 * tolerance,
             beside_sq = (1 + Real(1e-9)) * (within * within) - over.height * over.height;
  bool is_near[3], before[3], behind[3], is_at[3];
  for (int k = 0; k < 3; k++) {
    const int last = (k + 2) % 3;    // the edge that ends at vertex k, where edge k begins
    const Real c = dot(face.inward[k], face.inward[last]),
               // The distance of q from vertex k along these edges, times the sine of their angle.
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

// Adds the contacts of these parts of a face. `inside`: a face whose inside q is over, and whose edges therefore have no contact, or
// kNoFeature.
template <int kMost>
LSDCD_NOINLINE void add_rim(const GridView &grid, FeatureCode face, unsigned in_reach,
                            FeatureCode inside, const Vec3 &q, Real cutoff, ContactSet<kMost> &set)
{
  const MeshGeometry geometry(grid, q);
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

// Adds the contact of a face if q is over its inside, and writes the face to `inside` if q is there by more than rounding. Otherwise
// returns which other parts of the face can have a contact, as parts_in_reach() does; 0 if none can. Only the record of the face is read,
// which for most faces shows that they are too far away.
template <int kMost>
LSDCD_FN unsigned add_inside(const GridView &grid, FeatureCode code, const Vec3 &q, Real cutoff,
                             FeatureCode &inside, ContactSet<kMost> &set)
{
  const FaceRecord &face = grid.wall.faces[feature_index(code)];
  const OverFace over(face, q);
  const Real distance = fabs(over.height);
  if (!(distance < cutoff) || over.is_past(cutoff)) return 0;
  if (!(over.least >= grid.tolerance)) return parts_in_reach(face, over, cutoff, grid.tolerance);
  if (over.least >= 2 * grid.tolerance) inside = code;
  add_once(set, code, {true, distance, over.height < 0 ? -face.normal : face.normal},
           grid.tolerance);
  return 0;
}

// Adds the contacts of a face with its edges and vertices, or of a lone edge or vertex. If q is over the inside of a face, only the face
// has a contact.
template <int kMost>
LSDCD_NOINLINE void add_primitive(const GridView &grid, FeatureCode primitive, const Vec3 &q,
                                  Real cutoff, ContactSet<kMost> &set)
{
  if (feature_kind(primitive) != FeatureKind::face) {
    add_feature_noinline(MeshGeometry(grid, q), primitive, cutoff, set);
    return;
  }
  FeatureCode inside = kNoFeature;
  const unsigned in_reach = add_inside(grid, primitive, q, cutoff, inside, set);
  if (in_reach != 0) add_rim(grid, primitive, in_reach, kNoFeature, q, cutoff, set);
}

}    // namespace lsdcd
