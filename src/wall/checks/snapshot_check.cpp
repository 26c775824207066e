// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/snapshot_check.h"

#include "base/input_error.h"

#include <string>

namespace lsdcd {

void SnapshotCheck::check(const std::deque<MeshPart> &meshes, const Step &step)
{
  const std::string a_replay = std::string("a ") + host_.names().replay;
  if (wall_.shapes)
    throw InputError(
        a_replay + " has no orientations of ellipsoids, because no " + host_.names().record +
        " gives them back, so contacts would be those of grains that lie otherwise: write a " +
        host_.names().saved + " in their place, and run 0 steps from it");
  for (const MeshPart &m : meshes) {
    m.mover->check_snapshot(step);
    m.surface->check_snapshot();
  }
  if (warned_) return;
  warned_ = true;
  if (wall_.law().has_history())
    host_.warn(a_replay + " does not know the springs of contacts, because no " +
               host_.names().record +
               " contains them: friction, rolling, twisting and adhesion past touch begin at 0 in "
               "each snapshot");
  if (wall_.has_loads())
    host_.warn(a_replay +
               " has no steps over which loads and wear add up: no wear is counted and no "
               "mesh_fields are written");
}

}    // namespace lsdcd
