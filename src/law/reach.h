// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How far beyond touch a law acts.
#pragma once

#include "base/cube_root.h"

#include <algorithm>

namespace lsdcd {

// The length of the gap in which a law still acts. `reduced`: the effective radius; `size`: that of the two grains,
// (Ri^3 + Rj^3)^(1/3). At a wall both are the radius.
struct LawReach {
  enum class Of {
    nothing,
    held,    // adhesion of surfaces that have touched
    near     // a pull that acts on all that is within reach
  };
  Of of = Of::nothing;
  Real constant = 0;    // length
  Real per_root = 0;    // times the cube root of `reduced`: length^(2/3)
  Real per_size = 0;    // times `size`
  // The gap l of the constant and of the size becomes l (1 + stretch l/reduced), up to kMostStretch of l: a rupture distance grows where
  // the bridge is large for its grain.
  Real stretch = 0;
  static constexpr Real kMostStretch = 0.1;

  LSDCD_FN bool acts() const { return of != Of::nothing; }
  LSDCD_FN bool needs_touch() const { return of == Of::held; }

  LSDCD_FN Real at(Real reduced, Real size) const
  {
    const Real l = constant + per_size * size;
    Real more = 0;
    if (stretch > 0) {
      more = stretch * l / reduced;
      if (!(more < kMostStretch)) more = kMostStretch;
    }
    return per_root * cube_root(reduced) + l * (1 + more);
  }
  // Returns the most that at() returns of radii that are no larger.
  Real most(Real reduced, Real size) const
  {
    return per_root * cube_root(reduced) +
           (constant + per_size * size) * (stretch > 0 ? 1 + kMostStretch : 1);
  }
};

// Returns the size of two grains that a LawReach reads.
LSDCD_FN Real size_of_both(Real radius_i, Real radius_j)
{
  return cube_root(radius_i * radius_i * radius_i + radius_j * radius_j * radius_j);
}

// Returns a reach that is at least as long as each of two.
inline LawReach longest(const LawReach &a, const LawReach &b)
{
  return {std::max(a.of, b.of), std::max(a.constant, b.constant), std::max(a.per_root, b.per_root),
          std::max(a.per_size, b.per_size), std::max(a.stretch, b.stretch)};
}

// Returns how far from its centre a sphere feels the wall.
LSDCD_FN Real cutoff_of(Real radius, const LawReach &reach)
{
  return reach.acts() ? radius + reach.at(radius, radius) : radius;
}

}    // namespace lsdcd
