// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/principal_frame.h"

#include <algorithm>

namespace lsdcd {

Principal principal_of(const SymmetricMatrix &inertia)
{
  const PrincipalAxes p = principal_axes(inertia);
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return p.value[i] < p.value[j]; });
  Principal sorted;
  for (int k = 0; k < 3; k++) {
    sorted.moment[k] = p.value[order[k]];
    sorted.axis[k] = p.axis[order[k]];
  }
  sorted.axis[2] = cross(sorted.axis[0], sorted.axis[1]);
  return sorted;
}

void place_in_principal_frame(const Principal &principal, std::vector<Ball> &balls,
                              MassProperties &clump)
{
  for (Ball &b : balls) {
    const Vec3 from_centre = b.centre - clump.centre;
    for (int k = 0; k < 3; k++) b.centre[k] = dot(principal.axis[k], from_centre);
  }
  clump.centre = {0, 0, 0};
  clump.inertia = SymmetricMatrix();
  clump.inertia.xx = principal.moment[0];
  clump.inertia.yy = principal.moment[1];
  clump.inertia.zz = principal.moment[2];
}

}    // namespace lsdcd
