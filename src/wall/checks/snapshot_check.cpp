// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/snapshot_check.h"

#include "base/input_error.h"

#include <algorithm>
#include <string>
#include <vector>

namespace lsdcd {

// Does a force or torque of a wall depend on how fast spheres spin?
static bool reads_spin(const WallSpec &wall)
{
  if (wall.law().rolling.is_on() || wall.law().twisting.is_on()) return true;
  const auto some = [](const std::vector<LawOfTypes> &rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [](const LawOfTypes &row) { return row.law.mu > 0; });
  };
  return some(wall.laws) || std::any_of(wall.meshes.begin(), wall.meshes.end(),
                                        [&some](const MeshSpec &mesh) { return some(mesh.laws); });
}

void SnapshotCheck::check(const std::deque<MeshPart> &meshes, const Step &step)
{
  const std::string a_replay = std::string("a ") + host_.names().replay;
  if (wall_.shapes)
    throw InputError(
        a_replay + " has no orientations of ellipsoids, because no " + host_.names().record +
        " gives them back, so contacts would be those of grains that lie otherwise: write a " +
        host_.names().saved + " in their place, and run 0 steps from it");
  if (wall_.average_every > 0)
    throw InputError(a_replay + " has no steps between its " + host_.names().record +
                     "'s snapshots, over which average " + std::to_string(wall_.average_every) +
                     " takes its means: leave average out");
  for (const MeshPart &m : meshes) {
    m.mover.check_snapshot(step);
    m.surface->check_snapshot();
  }
  if (warned_) return;
  warned_ = true;
  if (wall_.law().has_history())
    host_.warn(a_replay + " does not know the springs of contacts, because no " +
               host_.names().record +
               " contains them: friction, rolling, twisting and adhesion past touch begin at 0 in "
               "each snapshot");
  if (reads_spin(wall_))
    host_.warn(a_replay + " does not know how fast " + host_.names().sphere +
               "s spin, because no " + host_.names().record +
               " gives that back: friction, rolling and twisting are those of the spin that they "
               "had before");
  if (wall_.has_loads() || wall_.energy || wall_.impact_speed > 0)
    host_.warn(a_replay +
               " has no steps over which loads, wear, energy and impacts add up: none of these is "
               "counted, and no impact_spectrum and no mesh_fields are written");
}

}    // namespace lsdcd
