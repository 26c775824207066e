// Heat that a contact conducts from the wall into the sphere.
#pragma once

#include "model/contact.h"

namespace lsdcd {

template <class T>
struct NoHeat {
  static constexpr bool kOn = false;
};

// `radius`: 2 k a dT (Vargas and McCarthy 2001); `area`: h pi a^2 dT. Power.
template <class T>
struct Conduction {
  static constexpr bool kOn = true;
  bool by_area;
  T conductance;    // power/(length temperature), power/(length^2 temperature)

  LSDCD_FN T flow(const Contact<T> &c, T a) const
  {
    const T per_kelvin = by_area ? T(3.14159265358979323846) * a * a : 2 * a;
    return conductance * per_kelvin * c.wall_warmer;
  }
};

}    // namespace lsdcd
