// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "material/contact_moduli.h"

#include <initializer_list>

namespace lsdcd {

ContactModuli contact_moduli(const Elastic &a, const Elastic &b)
{
  Real soft = 0, soft_shear = 0;
  for (const Elastic *m : {&a, &b}) {
    const Real e = m->youngs_modulus, nu = m->poissons_ratio;
    soft += (1 - nu * nu) / e;
    soft_shear += 2 * (2 - nu) * (1 + nu) / e;
  }
  return {1 / soft, 1 / soft_shear};
}

// Touching itself, E* = E/(2(1-nu^2)) and G* = E/(4(2-nu)(1+nu)): E*/G* = 2(2-nu)/(1-nu).
Elastic as_one(const Elastic &a, const Elastic &b)
{
  const ContactModuli m = contact_moduli(a, b);
  const Real quotient = m.youngs / m.shear, nu = (quotient - 4) / (quotient - 2);
  return {2 * (1 - nu * nu) * m.youngs, nu};
}

}    // namespace lsdcd
