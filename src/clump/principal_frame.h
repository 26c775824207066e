// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The principal axes of a clump, and the clump placed along them.
#pragma once

#include "clump/ball.h"
#include "rigid/mass_properties.h"

#include <vector>

namespace lsdcd {

// Moments (mass length^2) along principal axes, the smallest first.
struct Principal {
  Real moment[3];
  Vec3 axis[3];    // unit, right-handed
};

Principal principal_of(const SymmetricMatrix &inertia);

// Moves and turns spheres such that their centre of mass is the origin and their principal axes are x, y and z, and gives `clump` the
// centre and inertia of that place. `principal` is of its inertia.
void place_in_principal_frame(const Principal &principal, std::vector<Ball> &balls,
                              MassProperties &clump);

}    // namespace lsdcd
