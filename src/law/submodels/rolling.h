// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rolling resistance: a contact torque against the turning of a sphere along the wall.
//
// A model is a struct with
//   kModel                           its value of RollingModel
//   kStoresVector                     does a contact store a vector of the tangent plane for it?
//   contact_torque(n, in, m, at)     torque on the sphere
//   energy(n, in, m, at)             what is held
// where n are its numbers in the order of its row (sub_models.cpp), m is the contact's memory, and `at` the
// index of its vector there. GranularRolling or ClassicRolling, below, lists it.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class RollingModel { none, sds, cdt, epsd2 };

// Arguments of a rolling model.
template <class T>
struct RollingInput {
  const Contact<T> &contact;
  T elastic;      // normal force without damping
  T normal;       // normal force
  T limit;        // > 0, the force that sliding limits are proportional to
  T k_tangent;    // tangential stiffness, force/length
};

// `sds` k gamma mu: spring, dashpot and slider (Luding 2008; Wang et al. 2015 for the velocity). Their
// force acts at the lever arm R on both sides of the contact, so that it turns the sphere
// and does not push it. The vector is the spring's displacement.
template <class T>
struct SdsRolling {
  static constexpr RollingModel kModel = RollingModel::sds;
  static constexpr bool kStoresVector = true;

  template <class Memory>
  LSDCD_FN static Vec3Of<T> contact_torque(const T *n, const RollingInput<T> &in, Memory &m, int at)
  {
    const Contact<T> &c = in.contact;
    const T k = n[0], gamma = n[1], mu = n[2];
    const Vec3Of<T> v = c.radius * cross(c.omega, c.normal);
    Vec3Of<T> rolled = m.vec(at);
    if (c.update) rolled += c.dt * v;
    Vec3Of<T> f = -k * rolled - gamma * v;
    const T size = norm(f), limit = mu * in.limit;
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
  LSDCD_FN static T energy(const T *n, const RollingInput<T> &, const Memory &m, int at)
  {
    return T(0.5) * n[0] * norm_sq(m.vec(at));
  }
};

// ---- LIGGGHTS ----------------------------------------------------------------------------

// The rolling part of the sphere's angular velocity.
template <class T>
LSDCD_FN Vec3Of<T> rolling_part(const Vec3Of<T> &omega, const Vec3Of<T> &normal)
{
  return omega - dot(omega, normal) * normal;
}

// `cdt` mu, constant directional torque: mu k_n overlap R against the rolling, whatever its
// speed (Ai et al. 2011, model A). Near rest it changes sign from step to step, as any
// constant friction does, and the spin stays within a step's change of 0.
template <class T>
struct CdtRolling {
  static constexpr RollingModel kModel = RollingModel::cdt;
  static constexpr bool kStoresVector = false;

  template <class Memory>
  LSDCD_FN static Vec3Of<T> contact_torque(const T *n, const RollingInput<T> &in, Memory &, int)
  {
    const Contact<T> &c = in.contact;
    const Vec3Of<T> rolls = rolling_part(c.omega, c.normal);
    const T rate = norm(rolls);
    if (!(rate > 0)) return {0, 0, 0};
    return (-n[0] * in.elastic * c.radius / rate) * rolls;
  }
  template <class Memory>
  LSDCD_FN static T energy(const T *, const RollingInput<T> &, const Memory &, int)
  {
    return 0;
  }
};

// `epsd2` mu, elastic-plastic spring: a contact torque that grows by k_t R^2 per angle rolled, up to
// mu |F_n| R (Iwashita and Oda 1998; Ai et al. 2011, model C without its dashpot). The vector is the
// contact torque.
template <class T>
struct Epsd2Rolling {
  static constexpr RollingModel kModel = RollingModel::epsd2;
  static constexpr bool kStoresVector = true;

  template <class Memory>
  LSDCD_FN static Vec3Of<T> contact_torque(const T *n, const RollingInput<T> &in, Memory &m, int at)
  {
    const Contact<T> &c = in.contact;
    Vec3Of<T> held = m.vec(at);
    if (c.update) {
      const T stiff = in.k_tangent * c.radius * c.radius;
      held -= (stiff * c.dt) * rolling_part(c.omega, c.normal);
      held = rolling_part(held, c.normal);
    }
    const T size = norm(held), limit = n[0] * fabs(in.normal) * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    return held;
  }
  template <class Memory>
  LSDCD_FN static T energy(const T *, const RollingInput<T> &in, const Memory &m, int at)
  {
    const T stiff = in.k_tangent * in.contact.radius * in.contact.radius;
    return stiff > 0 ? T(0.5) * norm_sq(m.vec(at)) / stiff : T(0);
  }
};

// ---- the family --------------------------------------------------------------------------

// The models of one kernel. All contacts of a wall have the same one.
template <class T, template <class> class... Models>
struct Rolling {
  static constexpr bool kAllStore = (Models<T>::kStoresVector && ...);
  RollingModel model;
  T numbers[3];

  LSDCD_FN bool is_on() const { return ((model == Models<T>::kModel) || ...); }
  LSDCD_FN bool stores_vector() const
  {
    return ((model == Models<T>::kModel && Models<T>::kStoresVector) || ...);
  }
  // Adds to the contact torque and to the energy; nothing if no model is on.
  template <class Memory>
  LSDCD_FN void act(const RollingInput<T> &in, Memory &m, int at, Vec3Of<T> &torque,
                    T &energy) const
  {
    (act_as<Models<T>>(in, m, at, torque, energy), ...);
  }

 private:
  template <class Model, class Memory>
  LSDCD_FN void act_as(const RollingInput<T> &in, Memory &m, int at, Vec3Of<T> &torque,
                       T &energy) const
  {
    // A kernel without memory is for models without history.
    if constexpr (Memory::kSize > 0 || !Model::kStoresVector)
      if (model == Model::kModel) {
        torque += Model::contact_torque(numbers, in, m, at);
        energy += Model::energy(numbers, in, m, at);
      }
  }
};

// The models that go with `granular`, and those that go with a classic style.
template <class T>
using GranularRolling = Rolling<T, SdsRolling>;
template <class T>
using ClassicRolling = Rolling<T, CdtRolling, Epsd2Rolling>;

}    // namespace lsdcd
