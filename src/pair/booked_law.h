// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Selects, for a law, the smallest of those with which pairs have an energy balance.
#pragma once

#include "law/smallest_model.h"

#include <type_traits>

namespace lsdcd {

// A classic style, without rolling and cohesion, whose parts() says what its force is made of.
template <class Base>
struct BookedClassic : Base {
  template <class C>
  LSDCD_FN FullForce evaluate(const C &c, ContactMemory<0> &memory) const
  {
    return {Base::evaluate(c, memory), {0, 0, 0}, 0};
  }
  // Returns the energy that the normal force of a contact would hold at this overlap.
  template <class C>
  LSDCD_FN Real normal_energy(C c, Real overlap) const
  {
    c.overlap = overlap;
    return Base::elastic.energy(c, Base::scale(c));
  }
  template <class C>
  LSDCD_FN ForceParts parts(const C &c, const ContactMemory<0> &begun,
                            const ContactMemory<0> &memory, const FullForce &out) const
  {
    return Base::parts(c, begun.shear, memory.shear, out);
  }
};

// Calls make(law) with a law that keeps_forces, like with_energy_law(), except that a classic style alone has laws of its own.
// Walls have no such laws, because their kernels take longer to compile.
template <class Make>
auto with_booked_law(const ContactLaw &p, const Make &make)
{
  if (!p.is_classic() || p.is_extended()) return with_energy_law(p, make);
  return with_classic_law(
      p, [&](const auto &base) { return make(BookedClassic<std::decay_t<decltype(base)>>{base}); });
}

}    // namespace lsdcd
