// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/likely_scale.h"

#include "base/input_words.h"
#include "mesh/outside_box.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

// A floor may be far larger than a box along two axes, but no useful wall is along all three. For a
// mesh that is flat along an axis the other two have to distinguish millimetres from metres.
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

std::string likely_scale_text(const Vec3 &mesh, const PeriodicBox &box)
{
  if (box.any_follows()) return "";
  const Box bounds = box.bounds({0, 0, 0});
  Vec3 extents = mesh, room = bounds.hi - bounds.lo;
  if (box.dimension == 2) {    // an outline may be of any thickness
    extents.z = extents.x;
    room.z = room.x;
  }
  const Real factor = likely_scale(extents, room);
  return factor < 1 ? "; the file is probably in other units: add scale " + number_text(factor)
                    : "";
}

std::string too_large_text(const Vec3 &mesh, const Box &spans, const PeriodicBox &box)
{
  const std::string likely = likely_scale_text(mesh, box);
  if (likely.empty()) return "";
  return "the mesh is far larger than the box: it spans " + extents_text(spans) + ", the box " +
         extents_text(box.bounds({0, 0, 0})) + likely;
}

}    // namespace lsdcd
