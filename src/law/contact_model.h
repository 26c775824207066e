// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A contact law put together from sub-models at compile time. Every law has
//   kHistory           does it store a ContactMemory<kExtra> per contact?
//   kVectors, kScalars how many vectors and scalars that has beside the shear displacement
//   kBeyondContact, gap(c)    does it act beyond contact, and across how long a gap?
//   kReaches           is that by its cohesion, so that beyond touch nothing else acts?
//   kContactTorque, kHeat     does evaluate() also return a contact torque, a heat flow?
//   kYields            does a contact keep how far it has yielded? Then the law has plastic_loss() and plastic_loss_at_end()
//   kWholeArms         in a pair, is the arm of the tangential force the radius? Else it is less by half of the overlap.
//   kMidpoint          can friction and slip be taken at the middle of the overlap (is_at_midpoint())? Else they are at the
//                      radius
//   evaluate(contact, memory)    of a Contact or a PairContact
//   friction_spring(contact, begun, memory)    with kHistory, at a wall: the spring of friction, with the memory before and after
//                      evaluate()
// and, with kVectors or kScalars, and with kHeat
//   stores(k)           is the k-th of these vectors and scalars stored from step to step?
//   has_heat()         is there a heat flow?
// Laws with which energy is recorded (with_energy_law()) say with parts() what a force is made of.
// The classic laws, and the most frequent ones of `granular`, have no instruction and no memory for an
// effect that is off. Effects that few scenes use are together in one law, with a branch for each. It
// stores and exchanges only what is on.
#pragma once

#include "law/contact.h"
#include "law/force_parts.h"
#include "law/submodels/cohesion.h"
#include "law/submodels/damping.h"
#include "law/submodels/heat.h"
#include "law/submodels/normal.h"
#include "law/submodels/plastic.h"
#include "law/submodels/rolling.h"
#include "law/submodels/tangential.h"
#include "law/submodels/twisting.h"

#include <type_traits>

namespace lsdcd {

// A law of the classic styles.
template <class Normal, class Damping, class Tangential>
struct ContactModel {
  static constexpr bool kHistory = Tangential::kHistory;
  static constexpr int kVectors = 0, kScalars = 0, kExtra = 0;
  static constexpr bool kBeyondContact = false, kContactTorque = false, kHeat = false;
  static constexpr bool kReaches = false;
  static constexpr bool kYields = false, kWholeArms = true, kMidpoint = false;

  Normal elastic;
  Damping damping;
  Tangential tangential;
  bool limit_damping;

  // Returns the factor of the stiffnesses: the contact radius, or 1.
  LSDCD_FN Real scale(const Contact &c) const
  {
    return Normal::kUsesContactRadius ? elastic.contact_radius(c) : 1;
  }

  LSDCD_FN ContactForce evaluate(const Contact &c, ContactMemory<0> &memory) const
  {
    const Real scale = this->scale(c);
    ContactForce out;
    out.normal = elastic.force(c, scale) + damping.force(c, scale);
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.tangential = tangential.force(c, scale, out.normal, memory.shear);
    out.energy = elastic.energy(c, scale);
    if constexpr (kHistory) out.energy += tangential.energy(scale, memory.shear);
    return out;
  }

  // Returns the parts of the force `out` that evaluate() has returned. `begun` and `shear`: the spring before and after.
  template <class C>
  LSDCD_FN ForceParts parts(const C &c, const Vec3 &begun, const Vec3 &shear,
                            const ContactForce &out) const
  {
    ForceParts parts = {};
    parts.elastic = elastic.force(c, scale(c));
    if constexpr (kHistory)
      parts.friction = friction_spring(c, begun, shear);
    else
      parts.slides = is_below(out.tangential, c.mass * tangential.gamma, c.v_tangent);
    if constexpr (kHistory && Normal::kUsesContactRadius) {
      parts.limit = tangential.mu * fabs(out.normal);
      parts.dashpot_slides = scale(c) * c.mass * tangential.gamma * norm(c.v_tangent) > parts.limit;
    }
    return parts;
  }
  // Returns the spring of friction in a step. Its displacement was `begun` and is now `shear`.
  template <class C>
  LSDCD_FN SpringPart friction_spring(const C &c, const Vec3 &begun, const Vec3 &shear) const
  {
    if constexpr (kHistory)
      return {in_plane(begun, c.normal), shear, scale(c) * tangential.k, true};
    else
      return {};
  }
  LSDCD_FN SpringPart friction_spring(const Contact &c, const ContactMemory<0> &begun,
                                      const ContactMemory<0> &memory) const
  {
    return friction_spring(c, begun.shear, memory.shear);
  }
};

// The laws of the classic styles, with the formulas of LAMMPS 29Sep2021.
using HookeLaw = ContactModel<HookeNormal, MassVelocityDamping, LinearNoHistory>;
using HookeHistoryLaw = ContactModel<HookeNormal, MassVelocityDamping, LinearHistory>;
using HertzHistoryLaw = ContactModel<HertzNormal, MassVelocityDamping, LinearHistory>;

// Result of laws with kContactTorque or kHeat.
struct FullForce : ContactForce {
  Vec3 contact_torque;    // torque on the sphere beside that of the tangential force
  Real heat;              // power into the sphere
};

// A classic style with rolling resistance and cohesion. kHistory_: does a contact have a history?
template <class Base, bool kHistory_>
struct AddedModel {
  static constexpr bool kHistory = kHistory_;
  static constexpr int kVectors = kHistory ? 1 : 0, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kBeyondContact = false, kContactTorque = true, kHeat = false;
  static constexpr bool kReaches = false;
  static constexpr bool kYields = false, kWholeArms = true, kMidpoint = false;

  Base base;
  AnyRolling rolling;
  SjkrCohesion cohesion;
  Real k_tangent;    // per unit of Base::scale()

  LSDCD_FN bool stores(int) const { return rolling.stores_vector(); }

  template <class C>
  LSDCD_FN FullForce evaluate(const C &c, ContactMemory<kExtra> &memory) const
  {
    ContactMemory<0> sliding = {memory.shear};
    FullForce out = {base.evaluate(c, sliding), {0, 0, 0}, 0};
    memory.shear = sliding.shear;
    if (rolling.is_on()) {
      const Real scale = base.scale(c);
      const RollingInput<C> in = {c, fabs(out.normal), base.elastic.secant(c, scale),
                                  scale * k_tangent};
      rolling.act(in, memory, 0, out.contact_torque, out.energy);
    }
    if (cohesion.is_on()) {
      out.normal -= cohesion.pull(c);
      out.energy += cohesion.energy(c);
    }
    return out;
  }

  // Returns the energy that the normal force of a contact would hold at this overlap.
  template <class C>
  LSDCD_FN Real normal_energy(C c, Real overlap) const
  {
    c.overlap = overlap;
    return base.elastic.energy(c, base.scale(c)) + (cohesion.is_on() ? cohesion.energy(c) : 0);
  }
  // Returns the parts of the force `out` that evaluate() has returned. `begun` and `memory`: what the contact keeps before and after.
  template <class C>
  LSDCD_FN ForceParts parts(const C &c, const ContactMemory<kExtra> &begun,
                            const ContactMemory<kExtra> &memory, const FullForce &out) const
  {
    ContactForce of_base = out;
    if (cohesion.is_on()) of_base.normal = out.normal + cohesion.pull(c);
    ForceParts parts = base.parts(c, begun.shear, memory.shear, of_base);
    if (rolling.is_on()) {
      const Real scale = base.scale(c);
      const RollingInput<C> in = {c, fabs(of_base.normal), base.elastic.secant(c, scale),
                                  scale * k_tangent};
      rolling.part(in, begun, memory, 0, parts);
    }
    if (cohesion.is_on()) parts.elastic -= cohesion.pull(c);
    return parts;
  }
  LSDCD_FN SpringPart friction_spring(const Contact &c, const ContactMemory<kExtra> &begun,
                                      const ContactMemory<kExtra> &memory) const
  {
    return base.friction_spring(c, begun.shear, memory.shear);
  }
};

// The sub-models that a law of `granular` is compiled with, beside a normal one and its damping. Rolling, twisting, heat and
// cohesion may each be off.
enum class GranularSet {
  few,         // friction as in LAMMPS, but for `mindlin_rescale`
  midpoint,    // friction as in LIGGGHTS
  either,      // friction as in one of the two
  full,        // few with `mindlin_rescale`, rolling, twisting and heat as in LAMMPS
  all,         // those, and friction, rolling and cohesion as in LIGGGHTS
  reaching     // those, with cohesion that acts beyond touch in place of LIGGGHTS's
};

// The sub-models of `granular`, with the formulas of LAMMPS 4Jul2026.
template <class Normal, bool kHistory_, GranularSet kSet>
struct GranularModel {
  static constexpr bool kReaches = kSet == GranularSet::reaching;
  static constexpr bool kAll = kReaches || kSet == GranularSet::all,
                        kFull = kAll || kSet == GranularSet::full;
  static constexpr bool kHistory = kHistory_;
  static constexpr int kOfNormal = Normal::kScalars;    // numbers kept for the normal force
  static constexpr bool kYields = kOfNormal > 0;
  static_assert(!kYields || kHistory, "a contact keeps how far it has yielded");
  static constexpr int kVectors = kHistory && kFull ? 1 : 0, kScalars = 2 * kVectors + kOfNormal;
  static constexpr int kExtra = 3 * kVectors + kScalars;
  static constexpr bool kBeyondContact = Normal::kBeyondContact || kReaches;
  static_assert(!kReaches || (kHistory && !Normal::kBeyondContact),
                "cohesion that acts beyond touch is alone there, and such contacts are kept");
  static constexpr bool kContactTorque = (kHistory && kFull) || kAll, kHeat = kFull;
  static constexpr bool kWholeArms = false, kMidpoint = kAll || kSet == GranularSet::midpoint ||
                                                        kSet == GranularSet::either;
  using Rolls = std::conditional_t<kAll, AnyRolling, SpringRolling>;
  using Cohesion = std::conditional_t<kReaches, ReachingCohesion, SjkrCohesion>;
  static_assert(SpringRolling::kAllStore, "a law without memory has no contact torque");

  // Places in ContactMemory::extra.
  static constexpr int kRolled = 0, kRadius = 3, kTwist = 4, kYielded = 5 * kVectors;

  Normal elastic;
  GranularDamping damping;
  GranularFriction tangential;
  Rolls rolling;
  SpringTwisting twisting;
  Conduction conduction;
  Cohesion cohesion;
  bool uses_contact_radius;    // does anything, though the normal force may not?
  bool limit_damping;

  LSDCD_FN bool stores(int k) const
  {
    if constexpr (kYields)
      if (k >= 3 * kVectors) return elastic.stores(k - 3 * kVectors);
    return k == 0 ? rolling.stores_vector() : k == 1 ? tangential.rescale : twisting.is_on();
  }
  LSDCD_FN bool has_heat() const { return conduction.is_on(); }
  LSDCD_FN bool is_at_midpoint() const
  {
    return kSet == GranularSet::midpoint || (kMidpoint && tangential.at_midpoint);
  }

  // Returns across how long a gap a contact acts; a law without kBeyondContact has no such function.
  template <class C>
  LSDCD_FN Real gap(const C &c) const
  {
    if constexpr (kReaches)
      return cohesion.gap(c);
    else
      return elastic.pull_off > 0 ? elastic.pull_off * cube_root(c.radius) : 0;
  }
  // Returns whether only what has touched is held across the gap.
  LSDCD_FN bool needs_touch() const
  {
    if constexpr (kReaches)
      return cohesion.is_bridge();
    else
      return true;
  }

  template <class C>
  LSDCD_FN FullForce evaluate(const C &c, ContactMemory<kExtra> &memory) const
  {
    if constexpr (kReaches)
      if (!(c.overlap > 0)) return across_gap(c, memory);
    const Real a =
        uses_contact_radius || elastic.uses_contact_radius() ? elastic.contact_radius(c) : 0;
    if constexpr (kYields) elastic.update(c, memory.extra + kYielded);
    const Real f = normal_force(c, a, memory), gamma = damping_coefficient(c, a, f);

    FullForce out;
    out.normal = f - gamma * c.v_normal;
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.energy = energy_of_normal(c, a, memory);
    const Real limit = limit_of(c, f, out.normal, memory);

    out.tangential = friction(c, a, gamma, tangential.mu * limit, memory);
    if constexpr (kHistory) out.energy += tangential.energy(a, memory);
    out.contact_torque = {0, 0, 0};
    out.heat = 0;
    if constexpr (kContactTorque)
      rolling.act(RollingInput<C>{c, limit, elastic.secant(c, a), tangential.stiffness(a)}, memory,
                  kRolled, out.contact_torque, out.energy);
    if constexpr (kHistory && kFull)
      if (twisting.is_on()) {
        const TwistCoefficients t = twisting.coefficients(
            limit, a, tangential.stiffness(a), tangential.xgammat * gamma, tangential.mu);
        out.contact_torque += twisting.contact_torque(c, t, memory, kTwist) * c.normal;
        out.energy += twisting.energy(t, memory, kTwist);
      }
    if constexpr (kHeat)
      if (has_heat()) out.heat = conduction.flow(c, a);
    if constexpr (kAll)
      if (cohesion.is_on() && c.overlap > 0) {
        out.normal -= cohesion.pull(c);
        out.energy += cohesion.energy(c);
      }
    return out;
  }

  // Return the energy that the normal force of a contact would hold at this overlap. A contact that yields first goes there with what it
  // keeps; without `memory` it keeps nothing.
  template <class C>
  LSDCD_FN Real normal_energy(C c, Real overlap, ContactMemory<kExtra> memory) const
  {
    c.overlap = overlap;
    if constexpr (kReaches)
      if (!(overlap > 0)) return cohesion.energy(c);
    if constexpr (kYields) elastic.update(c, memory.extra + kYielded);
    Real held = energy_of_normal(c, elastic.contact_radius(c), memory);
    if constexpr (kAll)
      if (cohesion.is_on() && overlap > 0) held += cohesion.energy(c);
    return held;
  }
  template <class C>
  LSDCD_FN Real normal_energy(const C &c, Real overlap) const
  {
    return normal_energy(c, overlap, ContactMemory<kExtra>{});
  }
  // Returns the energy that a contact loses in a step by yielding and on its adhesive branch, with what it keeps before and after. A
  // contact that begins in overlap has yielded before.
  template <class C>
  LSDCD_FN Real plastic_loss(C c, ContactMemory<kExtra> begun,
                             const ContactMemory<kExtra> &memory) const
  {
    const Real before = c.overlap + c.dt * c.v_normal;
    if constexpr (kReaches)
      if (c.overlap < 0) c.overlap = 0;
    Real *const own = begun.extra + kYielded;
    if (own[0] == 0 && before > 0) {
      C was = c;
      was.overlap = before;
      elastic.update(was, own);
    }
    return elastic.loss(c, own, before, memory.extra + kYielded);
  }
  // Returns the energy that a contact loses which parts with what it keeps, and whose overlap was `before`.
  template <class C>
  LSDCD_FN Real plastic_loss_at_end(const C &c, const ContactMemory<kExtra> &memory,
                                    Real before) const
  {
    return elastic.loss_at_end(c, memory.extra + kYielded, before);
  }
  // Returns the parts of the force `out` that evaluate() has returned. `begun` and `memory`: what the contact keeps before and after.
  template <class C>
  LSDCD_FN ForceParts parts(const C &c, const ContactMemory<kExtra> &begun,
                            const ContactMemory<kExtra> &memory, const FullForce &out) const
  {
    if constexpr (kYields) {    // in a setup what it keeps has not moved
      ContactMemory<kExtra> here = memory;
      elastic.update(c, here.extra + kYielded);
      return parts_at(c, begun, memory, here, out);
    } else {
      return parts_at(c, begun, memory, memory, out);
    }
  }
  // Returns the spring of friction at a wall in a step.
  LSDCD_FN SpringPart friction_spring(const Contact &c, const ContactMemory<kExtra> &begun,
                                      const ContactMemory<kExtra> &memory) const
  {
    if (!tangential.spring) return {};
    if constexpr (kReaches)
      if (!(c.overlap > 0)) return {};
    const Real a = tangential.by_radius || tangential.rescale ? elastic.contact_radius(c) : 0;
    return tangential.part(c, a, begun, memory, kRadius, 0);    // the limit is for pairs alone
  }

 private:
  // Returns the force across a gap. What a contact keeps for surfaces that touch is gone.
  template <class C>
  LSDCD_FN FullForce across_gap(const C &c, ContactMemory<kExtra> &memory) const
  {
    memory.shear = {0, 0, 0};
    for (int k = 0; k < kYielded; k++) memory.extra[k] = 0;
    elastic.forget(memory.extra + kYielded);
    FullForce out = {};
    out.normal = -cohesion.pull(c);
    out.energy = cohesion.energy(c);
    return out;
  }
  // The following three functions are those of the normal model, which of a contact that yields reads what it keeps.
  template <class C, class Memory>
  LSDCD_FN Real normal_force(const C &c, [[maybe_unused]] Real a,
                             [[maybe_unused]] const Memory &memory) const
  {
    if constexpr (kYields)
      return elastic.force(c, memory.extra + kYielded);
    else
      return elastic.force(c, a);
  }
  template <class C, class Memory>
  LSDCD_FN Real energy_of_normal(const C &c, [[maybe_unused]] Real a,
                                 [[maybe_unused]] const Memory &memory) const
  {
    if constexpr (kYields)
      return elastic.energy(c, memory.extra + kYielded);
    else
      return elastic.energy(c, a);
  }
  template <class C, class Memory>
  LSDCD_FN Real limit_of(const C &c, Real f, Real normal,
                         [[maybe_unused]] const Memory &memory) const
  {
    if constexpr (kYields)
      return elastic.limit(c, f, normal, memory.extra + kYielded);
    else
      return elastic.limit(c, f, normal);
  }
  // Returns the coefficient of damping, which sees the stiffness of loading.
  template <class C>
  LSDCD_FN Real damping_coefficient(const C &c, Real a, Real f) const
  {
    if constexpr (kYields)
      return damping.coefficient(c, a, elastic.secant(c, a) * c.overlap);
    else
      return damping.coefficient(c, a, f);
  }
  // Returns parts(). `here`: what the contact keeps for its normal force at this overlap.
  template <class C>
  LSDCD_FN ForceParts parts_at(const C &c, const ContactMemory<kExtra> &begun,
                               const ContactMemory<kExtra> &memory,
                               const ContactMemory<kExtra> &here, const FullForce &out) const
  {
    static_assert(kHistory && (kAll || kSet == GranularSet::either),
                  "the energy balance is of the laws with either friction");
    if constexpr (kReaches)
      if (!(c.overlap > 0)) {    // springs have ended, see book_springs()
        ForceParts parts = {};
        parts.elastic = out.normal;
        return parts;
      }
    const Real a =
        uses_contact_radius || elastic.uses_contact_radius() ? elastic.contact_radius(c) : 0;
    Real pull = 0;
    if constexpr (kAll)
      if (cohesion.is_on() && c.overlap > 0) pull = cohesion.pull(c);
    const Real f = normal_force(c, a, here), gamma = damping_coefficient(c, a, f);
    const Real limit = limit_of(c, f, out.normal + pull, here);
    ForceParts parts = {};
    parts.elastic = f - pull;
    if (tangential.spring)
      parts.friction = tangential.part(c, a, begun, memory, kRadius, tangential.mu * limit);
    if (tangential.may_slave_spring()) {
      parts.limit = tangential.mu * limit;
      parts.dashpot_slides = tangential.xgammat * gamma * norm(c.v_tangent) > parts.limit;
    }
    if (!tangential.spring)
      parts.slides = is_below(out.tangential, tangential.xgammat * gamma, c.v_tangent);
    if constexpr (kFull) {
      rolling.part(RollingInput<C>{c, limit, elastic.secant(c, a), tangential.stiffness(a)}, begun,
                   memory, kRolled, parts);
      if (twisting.is_on()) {
        const TwistCoefficients t = twisting.coefficients(
            limit, a, tangential.stiffness(a), tangential.xgammat * gamma, tangential.mu);
        parts.twisting = {begun.extra[kTwist] * c.normal, memory.extra[kTwist] * c.normal, t.k,
                          false};
      }
    }
    return parts;
  }
  template <class C>
  LSDCD_FN Vec3 friction(const C &c, Real a, Real gamma, Real limit,
                         ContactMemory<kExtra> &memory) const
  {
    if constexpr (!kHistory) {
      return tangential.slip_force(c, gamma, limit);
    } else {
      if constexpr (kFull || kSet == GranularSet::either)
        if (!tangential.spring) return tangential.slip_force(c, gamma, limit);
      if constexpr (kFull) {
        if (tangential.rescale) tangential.rescale_spring(a, memory, kRadius);
      }
      if constexpr (kMidpoint)
        if (is_at_midpoint()) return tangential.sticking_force(c, a, gamma, limit, memory);
      return tangential.spring_force(c, a, gamma, limit, memory);
    }
  }
};

// Returns how many numbers of a contact's history a law has beside its shear displacement.
template <class Law>
LSDCD_FN int n_extra(const Law &law)
{
  int n = 0;
  if constexpr (Law::kExtra > 0)
    for (int k = 0; k < Law::kVectors + Law::kScalars; k++)
      if (law.stores(k)) n += k < Law::kVectors ? 3 : 1;
  return n;
}

// Copy the vectors and scalars of a memory that the law stores. `from`, `to`: pointers to these numbers, or types that act like one.
template <class Law, class From>
LSDCD_FN void read_extra(const Law &law, From from, ContactMemory<Law::kExtra> &memory)
{
  for (int k = 0; k < Law::kVectors; k++)
    if (law.stores(k)) {
      memory.put(3 * k, {from[0], from[1], from[2]});
      from += 3;
    }
  for (int k = 0; k < Law::kScalars; k++)
    if (law.stores(Law::kVectors + k)) memory.extra[3 * Law::kVectors + k] = *from++;
}
template <class Law, class To>
LSDCD_FN void write_extra(const Law &law, const ContactMemory<Law::kExtra> &memory, To to)
{
  for (int k = 0; k < Law::kVectors; k++)
    if (law.stores(k))
      for (int j = 0; j < 3; j++) *to++ = memory.extra[3 * k + j];
  for (int k = 0; k < Law::kScalars; k++)
    if (law.stores(Law::kVectors + k)) *to++ = memory.extra[3 * Law::kVectors + k];
}

}    // namespace lsdcd
