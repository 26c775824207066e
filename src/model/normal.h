// Normal elasticity: F = scale k overlap, with the scale of the contact's size.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// Linear spring. k: force/length.
struct HookeNormal {
  LSDCD_FN static Real scale(const Contact &) { return 1; }
  LSDCD_FN static Real energy(Real k, const Contact &c, Real)
  {
    return Real(0.5) * k * c.overlap * c.overlap;
  }
};

// Hertz: scale = contact radius sqrt(R overlap). k: force/length^2.
struct HertzNormal {
  LSDCD_FN static Real scale(const Contact &c) { return sqrt(c.overlap * c.radius); }
  LSDCD_FN static Real energy(Real k, const Contact &c, Real scale)
  {
    return Real(0.4) * k * scale * c.overlap * c.overlap;
  }
};

}    // namespace lsdcd
