// A contact law put together from sub-models at compile time.
#pragma once

#include "model/contact.h"
#include "model/damping.h"
#include "model/normal.h"
#include "model/tangential.h"

namespace lsdcd {

// An effect that is not among the template arguments costs no instruction and no
// memory. `stretch` is read and written only where kHistory.
template <class T, template <class> class Normal, template <class> class Damping,
          template <class> class Tangential>
struct ContactModel {
  using Number = T;
  static constexpr bool kHistory = Tangential<T>::kHistory;

  T k_normal;
  Damping<T> damping;
  Tangential<T> tangential;
  bool limit_damping;

  LSDCD_FN ContactForce<T> evaluate(const Contact<T> &c, Vec3Of<T> &stretch) const
  {
    const T scale = Normal<T>::scale(c);
    ContactForce<T> out;
    out.normal = scale * k_normal * c.overlap + damping.force(c, scale);
    if (limit_damping && out.normal < 0) out.normal = 0;
    out.tangential = tangential.force(c, scale, out.normal, stretch);
    out.energy = Normal<T>::energy(k_normal, c, scale);
    if constexpr (kHistory) out.energy += tangential.energy(scale, stretch);
    return out;
  }
};

// The classic styles of `fix wall/gran`, with the formulas of LAMMPS 29Sep2021.
template <class T>
using HookeLaw = ContactModel<T, HookeNormal, MassVelocityDamping, LinearNoHistory>;
template <class T>
using HookeHistoryLaw = ContactModel<T, HookeNormal, MassVelocityDamping, LinearHistory>;
template <class T>
using HertzHistoryLaw = ContactModel<T, HertzNormal, MassVelocityDamping, LinearHistory>;

}    // namespace lsdcd
