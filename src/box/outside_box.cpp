// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/outside_box.h"

#include "base/input_words.h"

namespace lsdcd {

std::string extents_text(const Box &box)
{
  std::string text;
  for (int k = 0; k < 3; k++)
    text += std::string(k ? ", " : "") + "xyz"[k] + " from " + number_text(box.lo[k]) + " to " +
            number_text(box.hi[k]);
  return text;
}

std::string outside_box(const Box &mesh, const PeriodicBox &box, Real near)
{
  // A part past a periodic face acts in the box by its image.
  Vec3 past = {near, near, near};
  for (int k = 0; k < 3; k++)
    if (box.periodic[k]) past[k] += box.width(k);
  const Box bounds = box.bounds(past);
  for (int k = 0; k < 3; k++) {
    const bool lo_stays = !box.face_follows[k][0], hi_stays = !box.face_follows[k][1];
    if ((mesh.hi[k] < bounds.lo[k] && lo_stays) || (mesh.lo[k] > bounds.hi[k] && hi_stays))
      return "the mesh is outside the box: it spans " + extents_text(mesh) + ", the box " +
             extents_text(box.bounds({0, 0, 0})) +
             "; check the units of the file (scale) and the position (move)";
  }
  return "";
}

}    // namespace lsdcd
