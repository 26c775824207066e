// Rolling resistance: a couple against the turning of a sphere along the wall.
#pragma once

#include "model/contact.h"

namespace lsdcd {

template <class T>
struct NoRolling {
  static constexpr bool kOn = false;
};

// `sds`: spring, dashpot and slider (Luding 2008; Wang et al. 2015 for the velocity). The
// force that they give acts at the lever arm R on both sides of the contact, so that it
// turns the sphere and does not push it. Its spring is the vector `at` of the memory.
template <class T>
struct SdsRolling {
  static constexpr bool kOn = true;
  T k, gamma, mu;    // force/length, mass/time, 1

  // `limit_force`: what the sliding limit is proportional to
  template <class Memory>
  LSDCD_FN Vec3Of<T> couple(const Contact<T> &c, T limit_force, Memory &m, int at) const
  {
    const Vec3Of<T> v = c.radius * cross(c.omega, c.normal);
    Vec3Of<T> rolled = m.vec(at);
    if (c.update) rolled += c.dt * v;
    Vec3Of<T> f = -k * rolled - gamma * v;
    const T size = norm(f), limit = mu * limit_force;
    if (size > limit) {
      if (norm_sq(rolled) > 0) {
        f = (limit / size) * f;
        if (k > 0) rolled = (-1 / k) * (f + gamma * v);
      } else {
        f = {0, 0, 0};
      }
    }
    m.put(at, rolled);
    return c.radius * cross(c.normal, f);
  }
  template <class Memory>
  LSDCD_FN T energy(const Memory &m, int at) const
  {
    return T(0.5) * k * norm_sq(m.vec(at));
  }
};

}    // namespace lsdcd
