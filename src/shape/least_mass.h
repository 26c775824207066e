// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// With which mass a grain that is no sphere meets a plane.
#pragma once

#include "shape/superellipsoid.h"

namespace lsdcd {

// Returns the least mass with which a point of the surface meets a plane, over that of the grain: the least 1 / (1 + (x cross n) J^-1 (x
// cross n)) of points x with the normal n, where J is inertia_over_mass(). It is 1 for a sphere, 1/4 for a long thin cylinder. A contact of
// stiffness k lasts pi sqrt(m/k) with this mass m, where one through the centre lasts longer.
Real least_mass_share(const Superellipsoid &s);

}    // namespace lsdcd
