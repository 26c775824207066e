// Normal elasticity: F = scale k overlap, with the scale of the contact's size.
#pragma once

#include "model/contact.h"

namespace lsdcd {

// Linear spring. k: force/length.
template <class T>
struct HookeNormal {
  LSDCD_FN static T scale(const Contact<T> &) { return 1; }
  LSDCD_FN static T energy(T k, const Contact<T> &c, T)
  {
    return T(0.5) * k * c.overlap * c.overlap;
  }
};

// Hertz: scale = contact radius sqrt(R overlap). k: force/length^2.
template <class T>
struct HertzNormal {
  LSDCD_FN static T scale(const Contact<T> &c) { return sqrt(c.overlap * c.radius); }
  LSDCD_FN static T energy(T k, const Contact<T> &c, T scale)
  {
    return T(0.4) * k * scale * c.overlap * c.overlap;
  }
};

}    // namespace lsdcd
