// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "shape/least_mass.h"

#include "shape/largest_on_surface.h"

namespace lsdcd {

Real least_mass_share(const Superellipsoid &s)
{
  const Vec3 inertia = inertia_over_mass(s);
  return 1 / largest_on_surface(s, [&](const Vec3 &x) {
           const Vec3 slope = gauge(s, x).slope, arm = cross(x, (1 / norm(slope)) * slope);
           return 1 + arm.x * arm.x / inertia.x + arm.y * arm.y / inertia.y +
                  arm.z * arm.z / inertia.z;
         });
}

}    // namespace lsdcd
