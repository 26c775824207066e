// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Twisting resistance: a contact torque against the turning of a sphere on the spot.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class TwistingModel : ModelNumber { none, marshall, sds };

// The coefficients of one contact.
struct TwistCoefficients {
  Real k, gamma, limit;    // torque/angle, torque time/angle, torque
};

// `sds` and `marshall`: spring, dashpot and slider (Marshall 2009, equations 30 to 44).
// The angle is the scalar `at` of the memory. `marshall` takes its coefficients from the
// tangential ones and the contact radius.
struct SpringTwisting {
  TwistingModel model;
  Real k, gamma, mu;    // torque/angle, torque time/angle, length; not for marshall

  LSDCD_FN bool is_on() const { return model != TwistingModel::none; }
  LSDCD_FN TwistCoefficients coefficients(Real limit_force, Real a, Real k_tangent,
                                          Real gamma_tangent, Real mu_tangent) const
  {
    if (model != TwistingModel::marshall) return {k, gamma, mu * limit_force};
    const Real half_sq = 0.5 * a * a;
    return {half_sq * k_tangent, half_sq * gamma_tangent,
            Real(2) / 3 * a * mu_tangent * limit_force};
  }

  // Returns the contact torque about the normal. Beyond the limit it is against the spin; in a setup, whose spin is that of another
  // time, the limit cuts it alone.
  template <class Memory>
  LSDCD_FN Real contact_torque(const Contact &c, const TwistCoefficients &t, Memory &m,
                               int at) const
  {
    const Real rate = dot(c.omega, c.normal);
    Real angle = m.extra[at];
    if (c.update) angle += c.dt * rate;
    Real contact_torque = -t.k * angle - t.gamma * rate;
    if (fabs(contact_torque) > t.limit) {
      const Real along = c.update ? rate : -contact_torque;
      contact_torque = along > 0 ? -t.limit : (along < 0 ? t.limit : 0);
      if (t.k > 0) angle = (-contact_torque - t.gamma * rate) / t.k;
    }
    m.extra[at] = angle;
    return contact_torque;
  }
  template <class Memory>
  LSDCD_FN Real energy(const TwistCoefficients &t, const Memory &m, int at) const
  {
    return 0.5 * t.k * m.extra[at] * m.extra[at];
  }
};

}    // namespace lsdcd
