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

#include <type_traits>

namespace lsdcd {

enum class RollingModel { none, sds, cdt, epsd2 };

// Arguments of a rolling model. C: Contact or PairContact.
template <class C>
struct RollingInput {
  const C &contact;
  Real elastic;      // normal force without damping
  Real normal;       // normal force
  Real limit;        // > 0, the force that sliding limits are proportional to
  Real k_tangent;    // tangential stiffness, force/length
};

// `sds` k gamma mu: spring, dashpot and slider (Luding 2008; Wang et al. 2015 for the velocity). Their
// force acts at the lever arm R on both sides of the contact, so that it turns the sphere
// and does not push it. The vector is the spring's displacement.
struct SdsRolling {
  static constexpr RollingModel kModel = RollingModel::sds;
  static constexpr bool kStoresVector = true;

  template <class In, class Memory>
  LSDCD_FN static Vec3 contact_torque(const Real *n, const In &in, Memory &m, int at)
  {
    const auto &c = in.contact;
    const Real k = n[0], gamma = n[1], mu = n[2];
    const Vec3 v = c.radius * cross(c.omega, c.normal);
    const Real limit = mu * in.limit;
    Vec3 rolled = m.vec(at);
    if constexpr (std::decay_t<decltype(c)>::kPair)
      if (c.update) rolled = turned_into_plane(rolled, c.normal, k, limit);
    if (c.update) rolled += c.dt * v;
    Vec3 f = -k * rolled - gamma * v;
    const Real size = norm(f);
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
  template <class In, class Memory>
  LSDCD_FN static Real energy(const Real *n, const In &, const Memory &m, int at)
  {
    return 0.5 * n[0] * norm_sq(m.vec(at));
  }
};

// ---- LIGGGHTS ----------------------------------------------------------------------------

// Returns the rolling part of the sphere's angular velocity.
LSDCD_FN Vec3 rolling_part(const Vec3 &omega, const Vec3 &normal)
{
  return omega - dot(omega, normal) * normal;
}

// `cdt` mu, constant directional torque: mu k_n overlap R against the spin, whatever its speed, of which the part
// across the normal acts (Ai et al. 2011, model A). A sphere that also spins about the normal rolls more freely. Near
// rest the torque changes sign from step to step, as any constant friction does, and the spin stays within a step's
// change of 0.
struct CdtRolling {
  static constexpr RollingModel kModel = RollingModel::cdt;
  static constexpr bool kStoresVector = false;

  template <class In, class Memory>
  LSDCD_FN static Vec3 contact_torque(const Real *n, const In &in, Memory &, int)
  {
    const auto &c = in.contact;
    const Real spin = norm(c.omega);
    if (!(spin > 0)) return {0, 0, 0};
    return (-n[0] * in.elastic * c.radius / spin) * rolling_part(c.omega, c.normal);
  }
  template <class In, class Memory>
  LSDCD_FN static Real energy(const Real *, const In &, const Memory &, int)
  {
    return 0;
  }
};

// `epsd2` mu, elastic-plastic spring: a contact torque that grows by k_t R^2 per angle rolled, up to
// mu |F_n| R (Iwashita and Oda 1998; Ai et al. 2011, model C without its dashpot). The vector is the
// contact torque.
struct Epsd2Rolling {
  static constexpr RollingModel kModel = RollingModel::epsd2;
  static constexpr bool kStoresVector = true;

  template <class In, class Memory>
  LSDCD_FN static Vec3 contact_torque(const Real *n, const In &in, Memory &m, int at)
  {
    const auto &c = in.contact;
    Vec3 held = m.vec(at);
    if (c.update) {
      const Real stiff = in.k_tangent * c.radius * c.radius;
      held -= (stiff * c.dt) * rolling_part(c.omega, c.normal);
      held = rolling_part(held, c.normal);
    }
    const Real size = norm(held), limit = n[0] * fabs(in.normal) * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    return held;
  }
  template <class In, class Memory>
  LSDCD_FN static Real energy(const Real *, const In &in, const Memory &m, int at)
  {
    const Real stiff = in.k_tangent * in.contact.radius * in.contact.radius;
    return stiff > 0 ? 0.5 * norm_sq(m.vec(at)) / stiff : 0;
  }
};

// ---- the family --------------------------------------------------------------------------

// The models of one kernel. All contacts of a wall have the same one.
template <class... Models>
struct Rolling {
  static constexpr bool kAllStore = (Models::kStoresVector && ...);
  RollingModel model;
  Real numbers[3];

  LSDCD_FN bool is_on() const { return ((model == Models::kModel) || ...); }
  LSDCD_FN bool stores_vector() const
  {
    return ((model == Models::kModel && Models::kStoresVector) || ...);
  }
  // Adds to the contact torque and to the energy; nothing if no model is on.
  template <class In, class Memory>
  LSDCD_FN void act(const In &in, Memory &m, int at, Vec3 &torque, Real &energy) const
  {
    (act_as<Models>(in, m, at, torque, energy), ...);
  }

 private:
  template <class Model, class In, class Memory>
  LSDCD_FN void act_as(const In &in, Memory &m, int at, Vec3 &torque, Real &energy) const
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
using GranularRolling = Rolling<SdsRolling>;
using ClassicRolling = Rolling<CdtRolling, Epsd2Rolling>;

}    // namespace lsdcd
