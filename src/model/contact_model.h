// A contact law put together from sub-models at compile time.
#pragma once

#include "model/contact.h"
#include "model/damping.h"
#include "model/normal.h"
#include "model/tangential.h"

namespace lsdcd {

// An effect that is not among the template arguments costs no instruction and no
// memory. `stretch` is read and written only where kHistory.
template <class Normal, class Damping, class Tangential>
struct ContactModel {
  static constexpr bool kHistory = Tangential::kHistory;

  Real k_normal;
  Damping damping;
  Tangential tangential;
  bool limit_damping;

  LSDCD_FN ContactForce evaluate(const Contact &c, Vec3 &stretch) const
  {
    const Real scale = Normal::scale(c);
    ContactForce out;
    out.normal = scale * k_normal * c.overlap + damping.force(c, scale);
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.tangential = tangential.force(c, scale, out.normal, stretch);
    out.energy = Normal::energy(k_normal, c, scale);
    if constexpr (kHistory) out.energy += tangential.energy(scale, stretch);
    return out;
  }
};

// The classic styles of `fix wall/gran`, with the formulas of LAMMPS 29Sep2021.
using HookeLaw = ContactModel<HookeNormal, MassVelocityDamping, LinearNoHistory>;
using HookeHistoryLaw = ContactModel<HookeNormal, MassVelocityDamping, LinearHistory>;
using HertzHistoryLaw = ContactModel<HertzNormal, MassVelocityDamping, LinearHistory>;

}    // namespace lsdcd
