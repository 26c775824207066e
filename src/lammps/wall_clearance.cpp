// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/wall_clearance.h"

#include "lammps/fix_wall_lsdcd.h"

namespace lsdcd {

bool WallClearance::has_all(bool has_meshes) const
{
  if (!has_meshes) return true;
  std::size_t n = 0;
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (std::size_t m = 0; m < wall->meshes().size(); m++, n++)
      if (n >= surfaces_.size() || surfaces_[n].fix != wall->id || surfaces_[n].index != m ||
          surfaces_[n].fingerprint != wall->meshes()[m].grid.mesh_fingerprint() ||
          surfaces_[n].shape != wall->meshes()[m].grid.shape() ||
          wall->meshes()[m].nodes)    // whose shape is another one each time
        return false;
  return n == surfaces_.size();
}

void WallClearance::follow(const std::vector<const LAMMPS_NS::FixWallLsdcd *> &walls,
                           bool has_meshes)
{
  walls_ = walls;
  if (has_all(has_meshes)) return;
  surfaces_.clear();
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (std::size_t m = 0; m < wall->meshes().size(); m++) {
      const MeshPart &part = wall->meshes()[m];
      surfaces_.emplace_back(wall->id, m, part.grid.mesh_fingerprint(), part.grid.shape(),
                             *part.mesh());
    }
}

void WallClearance::place(Real dt)
{
  std::size_t n = 0;
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (const MeshPart &part : wall->meshes())
      if (n < surfaces_.size()) surfaces_[n++].place(part, dt);
}

bool WallClearance::is_clear(Surface &surface, const PackedSphere &sphere, const PeriodicBox &box)
{
  // Images of the wall about the sphere are those of the sphere about the wall.
  for (const PackedSphere &image : images_in(sphere, surface.bounds, 0, box))
    if (surface.tree.is_within(surface.pose.to_mesh(image.at), image.radius, surface.hint))
      return false;
  return true;
}

bool WallClearance::is_clear(const PackedSphere &sphere, const PeriodicBox &box)
{
  for (Surface &surface : surfaces_)
    if (!is_clear(surface, sphere, box)) return false;
  return true;
}

bool WallClearance::is_clear_at_rest(const PackedSphere &sphere, const PeriodicBox &box)
{
  for (Surface &surface : surfaces_)
    if (!surface.moves && !is_clear(surface, sphere, box)) return false;
  return true;
}

std::size_t WallClearance::bytes() const
{
  std::size_t sum = 0;
  for (const Surface &surface : surfaces_) sum += surface.tree.bytes();
  return sum;
}

}    // namespace lsdcd
