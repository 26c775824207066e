// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Normal damping: F = -(coefficient) v_normal.
#pragma once

#include "law/contact.h"

namespace lsdcd {

// Units of eta: none; mass/time; 1/time; 1/(time length); a number, times the root of mass times secant
// stiffness; in classic styles 1/time (hooke) or 1/(time length) (hertz).
enum class DampingModel : ModelNumber {
  none,
  velocity,
  mass_velocity,
  viscoelastic,
  stiffness,
  classic
};

// The classic styles: coefficient = scale m gamma.
// gamma: 1/time with HookeNormal, 1/(time length) with HertzNormal.
struct MassVelocityDamping {
  Real gamma;

  LSDCD_FN Real force(const Contact &c, Real scale) const
  {
    return -scale * c.mass * gamma * c.v_normal;
  }
};

// The models of `granular`. All contacts of a wall have the same one.
struct GranularDamping {
  DampingModel model;
  Real eta;

  // mass/time, at a contact of radius a with the elastic force f
  LSDCD_FN Real coefficient(const Contact &c, Real a, Real f) const
  {
    if (model == DampingModel::stiffness) {    // per root of mass times secant stiffness
      const Real stiffness = c.mass * f / c.overlap;
      return stiffness > 0 ? eta * sqrt(stiffness) : 0;
    }
    if (model == DampingModel::velocity) return eta;
    if (model == DampingModel::mass_velocity) return eta * c.mass;
    return model == DampingModel::viscoelastic ? eta * c.mass * a : 0;
  }
};

}    // namespace lsdcd
