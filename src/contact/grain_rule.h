// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How the contacts of a grain that is no sphere share its overlaps (doc/notes/corners.md): the corner rule, with a cover that
// follows from the curvature of the grain, and with a fade of contacts that end at a fold.
#pragma once

#include "contact/corner.h"
#include "shape/superellipsoid.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace lsdcd {

// A contact in the frame of its grain.
struct SharingContact {
  FeatureCode feature;
  Vec3 normal;     // unit, out of the grain
  Vec3 point;      // of the grain's surface, with this normal
  Real overlap;    // length, > 0

  Vec3 foot() const { return point - overlap * normal; }    // on the wall
};

// How two contacts of a grain share.
struct GrainCover {
  Real uncovered = 1;    // one minus their cover; 1: they do not share
  // The torque on the grain, in its frame, that comes from the change of the cover as the grain turns, divided by the stiffness and
  // by the product of both l; length^-1.
  Vec3 couple = {0, 0, 0};
};

// Returns the cover of two contacts: the cosine of their normals, reduced the more, the flatter the surface between them is compared
// with its sharpest place. For a ball it is the cosine.
inline GrainCover cover_of(const Superellipsoid &s, const SharingContact &a,
                           const SharingContact &b)
{
  constexpr Real kParallel = 1e-10;
  const Real u = one_minus_cos(a.normal, b.normal), cosine = 1 - u;
  if (!(cosine > 0)) return {};
  GrainCover cover;
  cover.uncovered = uncovered(u);
  const Vec3 sum = a.normal + b.normal;
  const Real size = norm(sum), apart = norm(a.normal - b.normal);
  if (!(apart >= kParallel)) return cover;
  const SupportPlane middle = support(s, (1 / size) * sum);
  // The mean radius of curvature between the normals is `over` times this over `apart`.
  const Real over = (2 + size) / apart,
             rise = dot(a.normal, a.point) + dot(b.normal, b.point) - size * middle.height;
  const Real flat = over * rise - s.rho * apart, share = flat / s.nearest;
  if (!(flat > 0)) return cover;
  const Real exponent = -share * share / 2;
  cover.uncovered = uncovered(u - cosine * std::expm1(exponent));
  cover.couple = (-cosine * std::exp(exponent) * share / s.nearest * over) *
                 (cross(a.point, a.normal) + cross(b.point, b.normal) - cross(middle.point, sum));
  return cover;
}

// The fade of a contact begins when the root of its overlap above the pass is less than this share of the sum of both such roots.
constexpr Real kFadeFrom = 0.2;

// Returns the overlap of a pass up to which a contact does not fade because of another contact.
inline Real overlap_without_fade(Real overlap, Real other)
{
  constexpr Real kSquare = kFadeFrom / (1 - kFadeFrom) * (kFadeFrom / (1 - kFadeFrom));
  return (overlap - kSquare * other) / (1 - kSquare);
}

// Returns how much a contact fades because of another contact that is joined to it by a pass, whose least depth is `pass` > 0: 0 far
// from the pass, and without bound as the contact reaches it.
inline Real fade_beside(Real overlap, Real other, Real pass)
{
  constexpr Real kStrength = 0.3, kLeast = 1e-9;
  const auto above = [&](Real d) {
    return std::fmax(std::sqrt(std::fmax(d - pass, Real(0))), kLeast * std::sqrt(d));
  };
  const Real own = above(overlap), part = own / (own + above(other));
  if (!(part < kFadeFrom)) return 0;
  const Real more = kFadeFrom / part - 1, share = pass / overlap;
  return kStrength * more * more * share * share;
}

// The numbers of a grain's contacts that the corner rule reads.
struct GrainCornerSet {
  int n = 0;
  Real radius = 0;    // of the sphere around the grain
  std::vector<FeatureCode> feature;
  std::vector<Real> distance;    // the radius less the overlap
  std::vector<Real> fade;
  std::vector<GrainCover> cover;    // of contact i with j < i
  std::vector<Vec3> normal, foot;

  const GrainCover &between(int a, int b) const
  {
    const std::size_t high = a > b ? a : b, low = a > b ? b : a;
    return cover[high * (high - 1) / 2 + low];
  }
};
inline Real likeness(const GrainCornerSet &set, int a, int b)
{
  return 1 - set.between(a, b).uncovered;
}
inline Real uncovered(const GrainCornerSet &set, int a, int b)
{
  return set.between(a, b).uncovered;
}
inline Real fade_of(const GrainCornerSet &set, int i)
{
  return set.fade[i];
}
template <>
inline constexpr bool kFades<GrainCornerSet> = true;

// Returns whether contact i lies in the plane of contact k, under the part of the grain that has passed that plane. The height of
// the centre over the plane stands for the distance that a sphere has.
inline bool lies_in_plane(const GrainCornerSet &set, Real radius, int i, int k, Real tolerance)
{
  const Real rise = dot(set.foot[i] - set.foot[k], set.normal[k]);
  return std::fabs(rise) <= tolerance &&
         radius - set.distance[i] <= dot(set.foot[k], set.normal[k]);
}

// Computes the weights and covers of the contacts of one grain after another.
class GrainRule {
 public:
  // Takes the contacts of a grain, at least two. None of them fades yet.
  void begin(const Superellipsoid &shape, const std::vector<SharingContact> &contacts);
  // Makes contact i fade because of contact j, which a pass of depth `pass` > 0 joins to it. If a contact has several fades, the
  // strongest counts.
  void add_pass(int i, int j, Real pass);
  // Writes the weights. `tolerance`: length by which edges and vertices count as lying in a plane.
  void solve(Real tolerance, Real *weight);
  // Returns the couple of two contacts, see GrainCover.
  const Vec3 &couple(int i, int j) const { return set_.between(i, j).couple; }

  static constexpr int kMost = 512;    // contacts

 private:
  static constexpr int kFew = 8;

  Real overlap(int i) const { return set_.radius - set_.distance[i]; }

  GrainCornerSet set_;
  CornerRule<kFew, GrainCornerSet> few_;
  std::vector<CornerRule<kMost, GrainCornerSet>> many_;    // one, made when it is needed
};

}    // namespace lsdcd
