// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spheres/sphere_range.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lsdcd {

SphereRange range_of(Host &host, const SpheresOnCpu &spheres)
{
  const HostSpheres s = spheres.all();
  Real most[3] = {0, 0, -INFINITY};
  for (int i = 0; i < s.n; i++) {
    if (!s.may_be_in_group(i)) continue;
    most[0] = std::max(most[0], s.radius[i]);
    most[1] = std::max(most[1], s.mass[i]);
    most[2] = std::max(most[2], -s.mass[i]);
  }
  host.max(most, 3);
  return {most[0], most[1], most[1] > 0 ? -most[2] : 0};
}

bool warn_of_points(Host &host, const SpheresOnCpu &spheres)
{
  const HostSpheres s = spheres.all();
  Real count = 0;
  for (int i = 0; i < s.n; i++) count += s.is_in_group(i);
  host.sum(&count, 1);
  if (count == 0) return false;
  host.warn("all " + std::to_string(static_cast<std::int64_t>(count)) + " " + host.names().sphere +
            "s" + (s.group ? std::string(" of group ") + s.group : "") +
            " have radius 0: the wall acts on none; " + host.names().give_radii);
  return true;
}

}    // namespace lsdcd
