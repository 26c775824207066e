// Normal damping: F = -scale m gamma v_normal, as the classic styles have it.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// gamma: 1/time with HookeNormal, 1/(time length) with HertzNormal.
struct MassVelocityDamping {
  Real gamma;

  LSDCD_FN Real force(const Contact &c, Real scale) const
  {
    return -scale * c.mass * gamma * c.v_normal;
  }
};

}    // namespace lsdcd
