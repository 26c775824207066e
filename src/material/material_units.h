// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// SI values in LAMMPS's systems of units.
#pragma once

#include "material/material_file.h"

namespace lsdcd {

// Returns an SI value of the property in `units`: si, cgs, micro or nano. Throws InputError for others, which have no
// scale (lj) or are for atoms (real, metal, electron).
Real in_units(Real si, const Property &property, const std::string &units);

}    // namespace lsdcd
