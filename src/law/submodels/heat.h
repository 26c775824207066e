// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Heat that a contact conducts from the wall into the sphere.
#pragma once

#include "law/contact.h"

namespace lsdcd {

enum class HeatModel : ModelNumber { none, radius, area };

// `radius`: 2 k a dT (Vargas and McCarthy 2001); `area`: h pi a^2 dT. Power.
struct Conduction {
  HeatModel model;
  Real conductance;    // power/(length temperature), power/(length^2 temperature)

  LSDCD_FN bool is_on() const { return model != HeatModel::none; }
  LSDCD_FN Real flow(const Contact &c, Real a) const
  {
    const Real per_kelvin = model == HeatModel::area ? kPi * a * a : 2 * a;
    return conductance * per_kelvin * c.temperature_difference;
  }
};

}    // namespace lsdcd
