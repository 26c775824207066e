// Tangential friction, with and without a spring, limited by Coulomb's law.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// Viscous friction up to mu |F_normal| (`hooke`).
struct LinearNoHistory {
  static constexpr bool kHistory = false;
  Real gamma, mu;

  LSDCD_FN Vec3 force(const Contact &c, Real, Real f_normal, Vec3 &) const
  {
    const Real speed = norm(c.v_tangent);
    if (!(speed > 0)) return {0, 0, 0};
    const Real viscous = c.mass * gamma * speed, limit = mu * fabs(f_normal);
    return (-(viscous < limit ? viscous : limit) / speed) * c.v_tangent;
  }
  LSDCD_FN Real energy(Real, const Vec3 &) const { return 0; }
};

// A spring and a dashpot in the tangent plane; where they exceed mu |F_normal|
// the spring is cut back to what the limit allows (`*/history`; Silbert et al.
// 2001). `stretch` is moved with the contact where c.update is set.
struct LinearHistory {
  static constexpr bool kHistory = true;
  Real k, gamma, mu;

  LSDCD_FN Vec3 force(const Contact &c, Real scale, Real f_normal, Vec3 &stretch) const
  {
    if (c.update) stretch += c.dt * c.v_tangent;
    const Real stretched = norm(stretch);
    if (c.update) stretch -= dot(stretch, c.normal) * c.normal;

    const Vec3 viscous = (c.mass * gamma) * c.v_tangent;
    const Vec3 f = -scale * (k * stretch + viscous);
    const Real size = norm(f), limit = mu * fabs(f_normal);
    if (!(size > limit)) return f;
    if (!(stretched > 0)) return {0, 0, 0};
    const Real part = limit / size;
    if (c.update && k > 0) stretch = part * (stretch + (1 / k) * viscous) - (1 / k) * viscous;
    return part * f;
  }
  LSDCD_FN Real energy(Real scale, const Vec3 &stretch) const
  {
    return Real(0.5) * scale * k * norm_sq(stretch);
  }
};

}    // namespace lsdcd
