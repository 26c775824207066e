// Rolling resistance: a contact torque against the turning of a sphere along the wall.
#pragma once

#include "law/contact.h"
#include "law/contact_law.h"

namespace lsdcd {

// `sds`: spring, dashpot and slider (Luding 2008; Wang et al. 2015 for the velocity). The
// force that they give acts at the lever arm R on both sides of the contact, so that it
// turns the sphere and does not push it. Its spring is the vector `at` of the memory.
template <class T>
struct SdsRolling {
  bool is_on;
  T k, gamma, mu;    // force/length, mass/time, 1

  // `limit_force`: what the sliding limit is proportional to
  template <class Memory>
  LSDCD_FN Vec3Of<T> contact_torque(const Contact<T> &c, T limit_force, Memory &m, int at) const
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

// ---- of LIGGGHTS, beside a classic style -------------------------------------------------

// The part of the sphere's turning that rolls.
template <class T>
LSDCD_FN Vec3Of<T> rolling_part(const Vec3Of<T> &omega, const Vec3Of<T> &normal)
{
  return omega - dot(omega, normal) * normal;
}

template <class T>
struct LiggghtsRolling {
  AddedRolling model;
  T mu;

  LSDCD_FN bool is_on() const { return model != AddedRolling::none; }

  // `cdt`, constant directional torque: mu k_n overlap R against the rolling, whatever its
  // speed (Ai et al. 2011, model A). Near rest it changes sign from step to step, as any
  // constant friction does, and the spin stays within a step's change of 0. `elastic`: the elastic force.
  LSDCD_FN Vec3Of<T> cdt(const Contact<T> &c, T elastic) const
  {
    const Vec3Of<T> rolls = rolling_part(c.omega, c.normal);
    const T rate = norm(rolls);
    if (!(rate > 0)) return {0, 0, 0};
    return (-mu * elastic * c.radius / rate) * rolls;
  }

  // `epsd2`, elastic-plastic spring: a contact torque that grows by k_t R^2 per angle rolled, up to
  // mu |F_n| R (Iwashita and Oda 1998; Ai et al. 2011, model C without its dashpot). The
  // contact torque is the vector `at` of the memory. `normal`: the normal force, damping included;
  // `k_tangent`: force/length.
  template <class Memory>
  LSDCD_FN Vec3Of<T> epsd2(const Contact<T> &c, T normal, T k_tangent, Memory &m, int at) const
  {
    Vec3Of<T> held = m.vec(at);
    if (c.update) {
      const T stiff = k_tangent * c.radius * c.radius;
      held -= (stiff * c.dt) * rolling_part(c.omega, c.normal);
      held = rolling_part(held, c.normal);
    }
    const T size = norm(held), limit = mu * fabs(normal) * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    return held;
  }
  // What epsd2 holds.
  template <class Memory>
  LSDCD_FN T energy(const Contact<T> &c, T k_tangent, const Memory &m, int at) const
  {
    const T stiff = k_tangent * c.radius * c.radius;
    return stiff > 0 ? T(0.5) * norm_sq(m.vec(at)) / stiff : T(0);
  }
};

}    // namespace lsdcd
