// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rolling resistance: a contact torque against the turning of a sphere along the wall.
//
// A model is a struct with
//   kModel                           its value of RollingModel
//   kStoresVector                     does a contact store a vector of the tangent plane for it?
//   contact_torque(n, in, m, at)     torque on the sphere
//   energy(n, in, m, at)             what is held
//   part(n, in, begun, m, at)        its spring in terms of the angle rolled, of a step with this memory before and after it
//   turning(c)                       the angular velocity that turns the spring
// where n are its numbers in the order of its row (sub_models.cpp), m is the contact's memory, and `at` the
// index of its vector there. AnyRolling, below, lists it.
#pragma once

#include "law/contact.h"
#include "law/force_parts.h"

#include <type_traits>

namespace lsdcd {

enum class RollingModel : ModelNumber { none, sds, cdt, epsd2, epsd, epsd3 };

// Arguments of a rolling model. C: Contact or PairContact.
template <class C>
struct RollingInput {
  const C &contact;
  Real limit;        // > 0, the force that sliding limits are proportional to
  Real k_normal;     // secant stiffness without adhesion, force/length
  Real k_tangent;    // tangential stiffness, force/length
};

// Returns the part of an angular velocity that rolls.
LSDCD_FN Vec3 rolling_part(const Vec3 &omega, const Vec3 &normal)
{
  return omega - dot(omega, normal) * normal;
}

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
  template <class In, class Memory>
  LSDCD_FN static SpringPart part(const Real *n, const In &in, const Memory &begun, const Memory &m,
                                  int at)
  {
    const auto &c = in.contact;
    Vec3 rolled = begun.vec(at);
    if constexpr (std::decay_t<decltype(c)>::kPair)
      if (c.update) rolled = turned_into_plane(rolled, c.normal, n[0], n[2] * in.limit);
    const Real per_radius = 1 / c.radius;
    return {per_radius * cross(c.normal, rolled), per_radius * cross(c.normal, m.vec(at)),
            n[0] * c.radius * c.radius, false};
  }
  template <class C>
  LSDCD_FN static Vec3 turning(const C &c)
  {
    return rolling_part(c.omega, c.normal);
  }
};

// ---- LIGGGHTS ----------------------------------------------------------------------------

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
    if (!(spin > 0 && c.overlap > 0)) return {0, 0, 0};
    return (-n[0] * (in.k_normal * c.overlap) * c.radius / spin) * rolling_part(c.omega, c.normal);
  }
  template <class In, class Memory>
  LSDCD_FN static Real energy(const Real *, const In &, const Memory &, int)
  {
    return 0;
  }
  template <class In, class Memory>
  LSDCD_FN static SpringPart part(const Real *, const In &, const Memory &, const Memory &, int)
  {
    return {};
  }
  template <class C>
  LSDCD_FN static Vec3 turning(const C &c)
  {
    return rolling_part(c.omega, c.normal);
  }
};

// Returns the angular velocity that the elastic-plastic springs turn by. At a wall LIGGGHTS divides the slip of a spin, at
// the middle of the overlap, by the distance of the centre.
template <class C>
LSDCD_FN Vec3 rolling_velocity(const C &c)
{
  const Vec3 rolls = rolling_part(c.omega, c.normal);
  const Real distance = c.radius - c.overlap;
  if (C::kPair || !(distance > 0)) return rolls;
  return ((c.radius - c.overlap / 2) / distance) * rolls;
}

// Returns the moment of inertia about the contact: 7/5 m R^2 of a sphere at a wall, of two the reduced one.
template <class C>
LSDCD_FN Real rolling_inertia(const C &c)
{
  if constexpr (C::kPair) {
    const Real i = c.mass_i * c.radius_i * c.radius_i, j = c.mass_j * c.radius_j * c.radius_j;
    return 1.4 * i * j / (i + j);
  } else {
    return 1.4 * c.mass * c.radius * c.radius;
  }
}

// An elastic-plastic spring of rolling (Iwashita and Oda 1998; Ai et al. 2011, model C): a contact torque that grows by
// Model::stiffness() per angle rolled, up to mu |F_n| R, and while it is below that a dashpot of Model::damping() times the
// critical one. The vector is the spring's torque.
template <class Model>
struct ElasticPlasticRolling {
  static constexpr bool kStoresVector = true;

  template <class In, class Memory>
  LSDCD_FN static Vec3 contact_torque(const Real *n, const In &in, Memory &m, int at)
  {
    const auto &c = in.contact;
    const Vec3 rolls = rolling_velocity(c);
    const Real stiff = Model::stiffness(n, in), damping = Model::damping(n);
    Vec3 held = m.vec(at);
    if (c.update) held = rolling_part(held - (stiff * c.dt) * rolls, c.normal);
    const Real size = norm(held), limit = n[0] * in.limit * c.radius;
    if (size > limit) held = (limit / size) * held;
    m.put(at, held);
    if (!(damping > 0) || is_cut(size, limit, c)) return held;
    return held - (2 * damping * sqrt(rolling_inertia(c) * stiff)) * rolls;
  }
  template <class In, class Memory>
  LSDCD_FN static Real energy(const Real *n, const In &in, const Memory &m, int at)
  {
    const Real stiff = Model::stiffness(n, in);
    return stiff > 0 ? 0.5 * norm_sq(m.vec(at)) / stiff : 0;
  }
  template <class In, class Memory>
  LSDCD_FN static SpringPart part(const Real *n, const In &in, const Memory &begun, const Memory &m,
                                  int at)
  {
    const Real stiff = Model::stiffness(n, in);
    if (!(stiff > 0)) return {};
    return {(-1 / stiff) * in_plane(begun.vec(at), in.contact.normal), (-1 / stiff) * m.vec(at),
            stiff, true};
  }
  template <class C>
  LSDCD_FN static Vec3 turning(const C &c)
  {
    return rolling_velocity(c);
  }
};

// `epsd2` mu: the stiffness k_t R^2, and no dashpot.
struct Epsd2Rolling : ElasticPlasticRolling<Epsd2Rolling> {
  static constexpr RollingModel kModel = RollingModel::epsd2;

  template <class In>
  LSDCD_FN static Real stiffness(const Real *, const In &in)
  {
    return in.k_tangent * in.contact.radius * in.contact.radius;
  }
  LSDCD_FN static Real damping(const Real *) { return 0; }
};

// `epsd` mu damping: the stiffness 2.25 k_n mu^2 R^2.
struct EpsdRolling : ElasticPlasticRolling<EpsdRolling> {
  static constexpr RollingModel kModel = RollingModel::epsd;

  template <class In>
  LSDCD_FN static Real stiffness(const Real *n, const In &in)
  {
    const Real arm = n[0] * in.contact.radius;
    return 2.25 * in.k_normal * arm * arm;
  }
  LSDCD_FN static Real damping(const Real *n) { return n[1]; }
};

// `epsd3` mu damping stiffness: epsd with a number in place of 2.25.
struct Epsd3Rolling : ElasticPlasticRolling<Epsd3Rolling> {
  static constexpr RollingModel kModel = RollingModel::epsd3;

  template <class In>
  LSDCD_FN static Real stiffness(const Real *n, const In &in)
  {
    const Real arm = n[0] * in.contact.radius;
    return n[2] * in.k_normal * arm * arm;
  }
  LSDCD_FN static Real damping(const Real *n) { return n[1]; }
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
  // Adds the torque and the energy of the model; adds nothing if no model is on.
  template <class In, class Memory>
  LSDCD_FN void act(const In &in, Memory &m, int at, Vec3 &torque, Real &energy) const
  {
    (act_as<Models>(in, m, at, torque, energy), ...);
  }
  // Sets the parts of the torque that act() adds; sets nothing if no model is on.
  template <class In, class Memory>
  LSDCD_FN void part(const In &in, const Memory &begun, const Memory &m, int at,
                     ForceParts &parts) const
  {
    (part_as<Models>(in, begun, m, at, parts), ...);
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
  template <class Model, class In, class Memory>
  LSDCD_FN void part_as(const In &in, const Memory &begun, const Memory &m, int at,
                        ForceParts &parts) const
  {
    if (model != Model::kModel) return;
    parts.rolling = Model::part(numbers, in, begun, m, at);
    parts.rolls = Model::turning(in.contact);
  }
};

// The models of kernels: that of LAMMPS, for walls without a sub-model of LIGGGHTS; and all.
using SpringRolling = Rolling<SdsRolling>;
using AnyRolling = Rolling<SdsRolling, CdtRolling, Epsd2Rolling, EpsdRolling, Epsd3Rolling>;

}    // namespace lsdcd
