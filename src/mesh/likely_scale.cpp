// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/likely_scale.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// A floor may be far larger than a box along two axes, but no useful wall is along all three. For a
// mesh that is flat along an axis the other two have to tell millimetres from metres.
Real likely_scale(const Vec3 &mesh, const Vec3 &box)
{
  constexpr Real kTooLarge = 20, kFlatTooLarge = 300, kFlat = 1e-6;
  Real least = HUGE_VAL, limit = kTooLarge;
  for (int k = 0; k < 3; k++)
    if (mesh[k] > kFlat * norm(mesh))
      least = std::min(least, mesh[k] / box[k]);
    else
      limit = kFlatTooLarge;
  if (!(least > limit)) return 1;
  const Real ratio = norm(mesh) / norm(box);
  Real best = 1;
  // Micrometres, millimetres, centimetres, inches and feet to metres.
  for (Real factor : {1e-6, 1e-3, 1e-2, 0.0254, 0.3048})
    if (std::fabs(std::log(ratio * factor)) < std::fabs(std::log(ratio * best))) best = factor;
  return best;
}

}    // namespace lsdcd
