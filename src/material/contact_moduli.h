// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The moduli of two touching materials, for walls that take one material.
#pragma once

#include "base/real.h"

namespace lsdcd {

struct Elastic {
  Real youngs_modulus, poissons_ratio;    // pressure, 1
};

// E* and G* of a contact, pressure: 1/E* is the sum over both sides of (1-nu^2)/E, 1/G* of
// 2(2-nu)(1+nu)/E (Johnson, Contact Mechanics, 1985, chapters 4 and 7).
struct ContactModuli {
  Real youngs, shear;
};
ContactModuli contact_moduli(const Elastic &a, const Elastic &b);

// The material whose contact with itself has the moduli of a contact of a and b. LAMMPS
// takes a wall's E and nu for both sides.
Elastic as_one(const Elastic &a, const Elastic &b);

}    // namespace lsdcd
