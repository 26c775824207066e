// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "material/material_units.h"

#include "base/input_error.h"

#include <cmath>

namespace lsdcd {

namespace {

// A kilogram, a metre and a second are 10^n of these units.
struct System {
  const char *name;
  int mass, length, time;
};

const System kSystems[] = {
    {"si", 0, 0, 0},
    {"cgs", 3, 2, 0},       // gram, centimetre, second
    {"micro", 15, 6, 6},    // picogram, micrometre, microsecond
    {"nano", 21, 9, 9},     // attogram, nanometre, nanosecond
};

}    // namespace

Real in_units(Real si, const Property &property, const std::string &units)
{
  for (const System &s : kSystems) {
    if (units != s.name) continue;
    const int ten = property.mass * s.mass + property.length * s.length + property.time * s.time;
    // Powers of ten are exact up to the 22nd, their inverses are not.
    const Real power = std::pow(Real(10), std::abs(ten));
    return ten < 0 ? si / power : si * power;
  }
  const std::string why = units == "lj"
                              ? "they are reduced units, with no length or mass to convert to"
                              : "material values are for grains, in si, cgs, micro or nano";
  throw InputError("in 'material', the input script is in units " + units + ": " + why +
                   ". Write the contact style's numbers instead, or use 'units si', 'cgs', "
                   "'micro' or 'nano'");
}

}    // namespace lsdcd
