// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cohesion beside a normal law: a pull that acts where the surfaces touch.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class CohesionModel { none, sjkr };

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

}    // namespace lsdcd
