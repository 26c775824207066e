// Normal damping: F = -scale m gamma v_normal, as the classic styles have it.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// gamma: 1/time with HookeNormal, 1/(time length) with HertzNormal.
template <class T>
struct MassVelocityDamping {
  T gamma;

  LSDCD_FN T force(const Contact<T> &c, T scale) const
  {
    return -scale * c.mass * gamma * c.v_normal;
  }
};

}    // namespace lsdcd
