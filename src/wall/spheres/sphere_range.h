// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The range of the spheres of a host.
#pragma once

#include "host/host.h"
#include "wall/spheres/host_spheres.h"

namespace lsdcd {

// The spheres that can touch a wall, now or later.
struct SphereRange {
  Real radius = 0;                // the largest
  Real mass = 0, lightest = 0;    // the largest and smallest; 0: there is none
};

// Returns the range of the spheres of all processes. Collective.
SphereRange range_of(Host &host, const SpheresOnCpu &spheres);

// Warns if all spheres of the group are points, on which the wall does not act. Returns whether it has warned. Collective.
bool warn_of_points(Host &host, const SpheresOnCpu &spheres);

}    // namespace lsdcd
