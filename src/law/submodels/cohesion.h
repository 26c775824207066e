// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cohesion beside a normal law: a pull that acts where the surfaces touch.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class CohesionModel { none, sjkr };

// `sjkr` of LIGGGHTS: k times the area in which a plane cuts the sphere, pi (R^2 - r^2)
// with the centre's distance r = R - overlap. Friction does not see it.
struct SjkrCohesion {
  Real k;    // energy/length^3; 0: off

  LSDCD_FN bool is_on() const { return k > 0; }
  LSDCD_FN Real pull(const Contact &c) const
  {
    return kPi * k * c.overlap * (2 * c.radius - c.overlap);
  }
  // Returns the energy of the surfaces in contact; < 0.
  LSDCD_FN Real energy(const Contact &c) const
  {
    return -kPi * k * c.overlap * c.overlap * (c.radius - c.overlap / 3);
  }
};

}    // namespace lsdcd
