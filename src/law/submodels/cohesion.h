// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cohesion beside a normal law: a pull that acts where the surfaces touch, or also across a gap.
#pragma once

#include "base/arc_tangent.h"
#include "law/contact.h"
#include "law/reach.h"

namespace lsdcd {

enum class CohesionModel : ModelNumber {
  none,
  sjkr,
  capillary,
  capillary_share,
  constant,
  constant_weight,
  linear
};

// Returns whether the model acts beyond touch.
LSDCD_FN constexpr bool acts_beyond_touch(CohesionModel model)
{
  return model > CohesionModel::sjkr;
}

// `sjkr` of LIGGGHTS: k times the area in which the undeformed surfaces cut each other, of a sphere and a plane
// pi (R^2 - r^2) with the centre's distance r = R - overlap. Friction does not see it.
struct SjkrCohesion {
  Real k;    // energy/length^3; 0: off

  LSDCD_FN bool is_on() const { return k > 0; }
  LSDCD_FN Real pull(const Contact &c) const
  {
    return kPi * k * c.overlap * (2 * c.radius - c.overlap);
  }
  LSDCD_FN Real pull(const PairContact &c) const
  {
    const Real both = c.radius_i + c.radius_j, distance = both - c.overlap;
    return kPi / 4 * k * c.overlap * (2 * both - c.overlap) *
           ((2 * c.radius_i - c.overlap) * (2 * c.radius_j - c.overlap)) / (distance * distance);
  }
  // Returns the energy of the surfaces in contact; < 0.
  LSDCD_FN Real energy(const Contact &c) const
  {
    return -kPi * k * c.overlap * c.overlap * (c.radius - c.overlap / 3);
  }
  LSDCD_FN Real energy(const PairContact &c) const
  {
    const Real both = c.radius_i + c.radius_j, apart = c.radius_i - c.radius_j;
    return -kPi / 4 * k * c.overlap * c.overlap *
           (both - c.overlap / 3 - apart * apart / (both - c.overlap));
  }
};

// Return the size of the grains that a LawReach reads, and the mass of the lighter one.
LSDCD_FN Real size_of(const Contact &c)
{
  return c.radius;
}
LSDCD_FN Real size_of(const PairContact &c)
{
  return size_of_both(c.radius_i, c.radius_j);
}
LSDCD_FN Real lighter_mass(const Contact &c)
{
  return c.mass;
}
LSDCD_FN Real lighter_mass(const PairContact &c)
{
  return c.mass_i < c.mass_j ? c.mass_i : c.mass_j;
}

// The models that act beyond touch. Friction sees none of them.
// `capillary`: a liquid bridge of constant volume V, which forms at touch. Its pull is F0/(1 + 2.1 p + 10 p^2), p = s sqrt(R/2V), across a
// gap s, and F0 = 4 pi gamma R cos(theta) where the surfaces touch; R is the effective radius (Willett et al. 2000, equation 12, in which
// R' = 2 R). Rolling changes nothing, and no liquid is exchanged. `capillary/share`: V is a share of the volumes of the two grains.
// `constant` and `linear` act without having touched: a pull F0, or K times the overlap and `delta`, from an overlap of -delta on.
struct ReachingCohesion {
  CohesionModel model;
  // Of the pull: F0/R (capillary), F0 (constant), F0/mass (constant/weight), K (linear).
  Real strength;
  // p = falloff s sqrt(R), over the root of size_of()^3 if V is a share: 1/length^(3/2), or none.
  Real falloff;
  Real constant, per_size, stretch;    // of the LawReach

  LSDCD_FN bool is_on() const { return true; }
  LSDCD_FN bool is_bridge() const
  {
    return model == CohesionModel::capillary || model == CohesionModel::capillary_share;
  }
  LSDCD_FN LawReach reach() const
  {
    return {is_bridge() ? LawReach::Of::held : LawReach::Of::near, constant, 0, per_size, stretch};
  }
  // Returns the length of the gap at which the pull ends.
  template <class C>
  LSDCD_FN Real gap(const C &c) const
  {
    return reach().at(c.radius, per_size > 0 ? size_of(c) : Real(0));
  }
  // Returns p over the gap.
  template <class C>
  LSDCD_FN Real steepness(const C &c) const
  {
    const Real steep = falloff * sqrt(c.radius);
    if (model != CohesionModel::capillary_share) return steep;
    const Real size = size_of(c);
    return steep / (size * sqrt(size));
  }
  template <class C>
  LSDCD_FN Real pull(const C &c) const
  {
    if (model == CohesionModel::constant) return strength;
    if (model == CohesionModel::constant_weight) return strength * lighter_mass(c);
    if (model == CohesionModel::linear) return strength * (c.overlap + constant);
    const Real most = strength * c.radius;
    if (c.overlap >= 0) return most;
    const Real p = -c.overlap * steepness(c);
    return most / (1 + p * (Real(2.1) + 10 * p));
  }
  // Returns the energy that is held, 0 where the pull ends; < 0.
  template <class C>
  LSDCD_FN Real energy(const C &c) const
  {
    if (model == CohesionModel::linear)
      return -0.5 * strength * (c.overlap + constant) * (c.overlap + constant);
    if (!is_bridge()) return -pull(c) * (c.overlap + constant);
    const Real most = strength * c.radius, steep = steepness(c), end = gap(c);
    const Real s = c.overlap < 0 ? -c.overlap : Real(0);
    if (!(s < end)) return 0;
    // The integral of 1/(1 + 2.1 p + 10 p^2) is 2/r atan((20 p + 2.1)/r), r^2 = 4 * 10 - 2.1^2.
    constexpr Real kRootSq = Real(35.59);
    const Real root = sqrt(kRootSq), from = 20 * steep * s + Real(2.1),
               to = 20 * steep * end + Real(2.1);
    const Real between = arc_tangent(root * (to - from) / (kRootSq + from * to));
    const Real over = c.overlap > 0 ? c.overlap : Real(0);
    return -most * (2 / (root * steep) * between + over);
  }
  // Returns the steepest slope of the pull.
  template <class C>
  LSDCD_FN Real slope(const C &c) const
  {
    if (is_bridge()) return Real(2.1) * steepness(c) * strength * c.radius;
    return model == CohesionModel::linear ? strength : 0;
  }
};

}    // namespace lsdcd
