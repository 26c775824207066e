// Tangential friction, with and without a spring, limited by Coulomb's law.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// Viscous friction up to mu |F_normal| (`hooke`).
template <class T>
struct LinearNoHistory {
  static constexpr bool kHistory = false;
  T gamma, mu;

  LSDCD_FN Vec3Of<T> force(const Contact<T> &c, T, T f_normal, Vec3Of<T> &) const
  {
    const T speed = norm(c.v_tangent);
    if (!(speed > 0)) return {0, 0, 0};
    const T viscous = c.mass * gamma * speed, limit = mu * fabs(f_normal);
    return (-(viscous < limit ? viscous : limit) / speed) * c.v_tangent;
  }
  LSDCD_FN T energy(T, const Vec3Of<T> &) const { return 0; }
};

// A spring and a dashpot in the tangent plane; where they exceed mu |F_normal|
// the spring is cut back to what the limit allows (`*/history`; Silbert et al.
// 2001). `stretch` is moved with the contact where c.update is set.
template <class T>
struct LinearHistory {
  static constexpr bool kHistory = true;
  T k, gamma, mu;

  LSDCD_FN Vec3Of<T> force(const Contact<T> &c, T scale, T f_normal, Vec3Of<T> &stretch) const
  {
    if (c.update) stretch += c.dt * c.v_tangent;
    const T stretched = norm(stretch);
    if (c.update) stretch -= dot(stretch, c.normal) * c.normal;

    const Vec3Of<T> viscous = (c.mass * gamma) * c.v_tangent;
    const Vec3Of<T> f = -scale * (k * stretch + viscous);
    const T size = norm(f), limit = mu * fabs(f_normal);
    if (!(size > limit)) return f;
    if (!(stretched > 0)) return {0, 0, 0};
    const T part = limit / size;
    if (c.update && k > 0) stretch = part * (stretch + (1 / k) * viscous) - (1 / k) * viscous;
    return part * f;
  }
  LSDCD_FN T energy(T scale, const Vec3Of<T> &stretch) const
  {
    return T(0.5) * scale * k * norm_sq(stretch);
  }
};

}    // namespace lsdcd
