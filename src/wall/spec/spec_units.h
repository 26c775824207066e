// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A spec in the units of the wall.
#pragma once

#include "wall/spec/wall_spec.h"

namespace lsdcd {

// Checks a spec, as check_spec() does, and returns it with forces per area in place of pressures. `pressure`: a force per
// area of 1, in the unit of pressure; `velocity`: a force times time over a mass, in the unit of velocity. Throws InputError, too, where
// a law has a dashpot that these units do not allow (check_dashpots()).
WallSpec in_units(WallSpec spec, Real pressure, Real velocity);

}    // namespace lsdcd
