// A contact law put together from sub-models at compile time. Every law has
//   Number             the type that it computes in
//   kHistory           does it keep a ContactMemory<Number, kExtra> per contact?
//   kVectors, kScalars what of that is beside the shear displacement: vectors, then scalars
//   kBeyond, pull_off  does it act past touch, and up to what distance at radius 1?
//   kContactTorque, kHeat     does evaluate() also return a contact torque, a heat flow?
//   evaluate(contact, memory)
// An effect that is not among the template arguments costs no instruction and no memory.
#pragma once

#include "model/cohesion.h"
#include "model/contact.h"
#include "model/damping.h"
#include "model/heat.h"
#include "model/normal.h"
#include "model/rolling.h"
#include "model/tangential.h"
#include "model/twisting.h"

namespace lsdcd {

// The classic styles.
template <class T, template <class> class Normal, template <class> class Damping,
          template <class> class Tangential>
struct ContactModel {
  using Number = T;
  static constexpr bool kHistory = Tangential<T>::kHistory;
  static constexpr int kVectors = 0, kScalars = 0, kExtra = 0;
  static constexpr bool kBeyond = false, kContactTorque = false, kHeat = false;

  Normal<T> elastic;
  Damping<T> damping;
  Tangential<T> tangential;
  bool limit_damping;

  // What the stiffnesses are multiplied by: the contact radius, or 1.
  LSDCD_FN T scale(const Contact<T> &c) const
  {
    return Normal<T>::kSized ? elastic.contact_radius(c) : T(1);
  }

  LSDCD_FN ContactForce<T> evaluate(const Contact<T> &c, ContactMemory<T, 0> &memory) const
  {
    const T scale = this->scale(c);
    ContactForce<T> out;
    out.normal = elastic.force(c, scale) + damping.force(c, scale);
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.tangential = tangential.force(c, scale, out.normal, memory.shear);
    out.energy = elastic.energy(c, scale);
    if constexpr (kHistory) out.energy += tangential.energy(scale, memory.shear);
    return out;
  }
};

// With the formulas of LAMMPS 29Sep2021.
template <class T>
using HookeLaw = ContactModel<T, HookeNormal, MassVelocityDamping, LinearNoHistory>;
template <class T>
using HookeHistoryLaw = ContactModel<T, HookeNormal, MassVelocityDamping, LinearHistory>;
template <class T>
using HertzHistoryLaw = ContactModel<T, HertzNormal, MassVelocityDamping, LinearHistory>;

// Of laws with kContactTorque or kHeat.
template <class T>
struct FullForce : ContactForce<T> {
  Vec3Of<T> contact_torque;    // torque on the sphere that no force at the contact gives
  T heat;                      // power into the sphere
};

// A classic style with effects of LIGGGHTS beside it.
template <class Base, class Rolling, class Cohesion>
struct AddedModel {
  using Number = typename Base::Number;
  using T = Number;
  static constexpr int kVectors = Rolling::kVectors, kScalars = 0, kExtra = 3 * kVectors;
  static constexpr bool kHistory = Base::kHistory || kVectors > 0;
  static constexpr bool kBeyond = false, kContactTorque = Rolling::kOn, kHeat = false;

  Base base;
  Rolling rolling;
  Cohesion cohesion;
  T k_tangent;    // per unit of Base::scale()

  LSDCD_FN FullForce<T> evaluate(const Contact<T> &c, ContactMemory<T, kExtra> &memory) const
  {
    ContactMemory<T, 0> sliding = {memory.shear};
    FullForce<T> out = {base.evaluate(c, sliding), {0, 0, 0}, 0};
    memory.shear = sliding.shear;
    if constexpr (Rolling::kOn) {
      const T scale = base.scale(c);
      out.contact_torque = rolling.contact_torque(c, base.elastic.force(c, scale), out.normal,
                                                  scale * k_tangent, memory, 0);
      out.energy += rolling.energy(c, scale * k_tangent, memory, 0);
    }
    if constexpr (Cohesion::kOn) {
      out.normal -= cohesion.pull(c);
      out.energy += cohesion.energy(c);
    }
    return out;
  }
};

// The sub-models of `granular`, with the formulas of LAMMPS 4Jul2026.
template <class T, class Normal, class Tangential, class Rolling, class Twisting, class Heat>
struct GranularModel {
  using Number = T;
  static constexpr bool kHistory =
      Tangential::kHistory || Normal::kBeyond || Rolling::kOn || Twisting::kOn;
  static constexpr int kVectors = Rolling::kVectors;
  static constexpr int kScalars = Tangential::kScalars + (Twisting::kOn ? 1 : 0);
  static constexpr int kExtra = 3 * kVectors + kScalars;
  static constexpr bool kBeyond = Normal::kBeyond;
  static constexpr bool kContactTorque = Rolling::kOn || Twisting::kOn, kHeat = Heat::kOn;

  // Places in ContactMemory::extra.
  static constexpr int kRolled = 0, kRadius = 3 * kVectors, kTwist = kRadius + Tangential::kScalars;

  Normal elastic;
  GranularDamping<T> damping;
  Tangential tangential;
  Rolling rolling;
  Twisting twisting;
  Heat conduction;
  bool sized;    // does anything need the contact radius, though the normal force does not?
  bool limit_damping;

  LSDCD_FN FullForce<T> evaluate(const Contact<T> &c, ContactMemory<T, kExtra> &memory) const
  {
    const T a = Normal::kSized || sized ? elastic.contact_radius(c) : T(0);
    const T f = elastic.force(c, a), gamma = damping.coefficient(c, a, f);

    FullForce<T> out;
    out.normal = f - gamma * c.v_normal;
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.energy = elastic.energy(c, a);
    // What pulls holds the surfaces together also where the forces cancel.
    T limit;
    if constexpr (Normal::kAdhesive)
      limit = elastic.limit(c, f);
    else
      limit = fabs(out.normal);

    out.tangential = tangential.force(c, a, gamma, tangential.mu * limit, memory, kRadius);
    out.energy += tangential.energy(a, memory);
    out.contact_torque = {0, 0, 0};
    if constexpr (Rolling::kOn) {
      out.contact_torque += rolling.contact_torque(c, limit, memory, kRolled);
      out.energy += rolling.energy(memory, kRolled);
    }
    if constexpr (Twisting::kOn) {
      const TwistCoefficients<T> t = twisting.coefficients(limit, a, tangential.stiffness(a),
                                                           tangential.x * gamma, tangential.mu);
      out.contact_torque += twisting.contact_torque(c, t, memory, kTwist) * c.normal;
      out.energy += twisting.energy(t, memory, kTwist);
    }
    out.heat = 0;
    if constexpr (Heat::kOn) out.heat = conduction.flow(c, a);
    return out;
  }
};

}    // namespace lsdcd
