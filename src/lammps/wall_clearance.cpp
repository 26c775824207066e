// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/wall_clearance.h"

#include "lammps/fix_wall_lsdcd.h"
#include "mesh/measure_mesh.h"

namespace lsdcd {

bool WallClearance::has_all(bool has_meshes) const
{
  if (!has_meshes) return true;
  std::size_t n = 0;
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (std::size_t m = 0; m < wall->meshes().size(); m++, n++)
      if (n >= surfaces_.size() || surfaces_[n].fix != wall->id || surfaces_[n].index != m ||
          surfaces_[n].fingerprint != wall->meshes()[m].grid.mesh_fingerprint())
        return false;
  return n == surfaces_.size();
}

void WallClearance::follow(const std::vector<LAMMPS_NS::FixWallLsdcd *> &walls, bool has_meshes)
{
  walls_ = walls;
  if (has_all(has_meshes)) return;
  surfaces_.clear();
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (std::size_t m = 0; m < wall->meshes().size(); m++) {
      const MeshPart &part = wall->meshes()[m];
      surfaces_.emplace_back(wall->id, m, part.grid.mesh_fingerprint(), *part.mesh());
    }
}

void WallClearance::begin_step()
{
  nodes_.clear();
  for (LAMMPS_NS::FixWallLsdcd *wall : walls_) {
    wall->prepare_meshes();
    for (const MeshPart &part : wall->meshes())
      nodes_.push_back(part.nodes() ? wall->places_of_nodes(part.index) : std::vector<Vec3>());
  }
}

void WallClearance::place(Real dt)
{
  std::size_t n = 0;
  for (const LAMMPS_NS::FixWallLsdcd *wall : walls_)
    for (const MeshPart &part : wall->meshes()) {
      const std::vector<Vec3> &at = part.nodes() ? nodes_[n] : part.grid.mesh()->vertices;
      surfaces_[n++].place(at, part, dt);
    }
}

void WallClearance::Surface::place(const std::vector<Vec3> &vertices, const MeshPart &part, Real dt)
{
  if (!(mesh.vertices == vertices)) {
    mesh.vertices = vertices;
    set_bounds(mesh);
    search.reset();
  }
  pose = part.mover.pose_in(dt);
  moves = part.moves() || part.surface->changes();
  bounds = placed_bounds(pose, {mesh.report.lo, mesh.report.hi});
}

// The sphere's centre is then less than its radius from the mesh; a grain with a shape has a point of the mesh in it, and a clump has
// such a sphere.
bool WallClearance::Surface::overlaps(const PackedSphere &grain)
{
  if (!search) search = std::make_unique<Search>(mesh);
  const Vec3 at = pose.to_mesh(grain.at);
  if (!search->tree.is_within(at, grain.radius, search->hint)) return false;
  if (!grain.shape) return true;
  for (const Ball &ball : grain.shape->balls)
    if (search->tree.is_within(pose.to_mesh(grain.at + ball.centre), ball.radius, search->hint))
      return true;
  if (!grain.shape->balls.empty()) return false;
  PlacedGrain placed = grain.shape->grain;
  placed.centre = at;
  Vec3 axis[3];
  for (int k = 0; k < 3; k++)
    axis[k] = pose.turn_to_mesh({placed.row[0][k], placed.row[1][k], placed.row[2][k]});
  for (int k = 0; k < 3; k++) placed.row[k] = {axis[0][k], axis[1][k], axis[2][k]};
  return search->of_shapes.nearest(placed).distance < 0;
}

bool WallClearance::is_clear(Surface &surface, const PackedSphere &grain, const PeriodicBox &box)
{
  // Images of the wall about the grain are those of the grain about the wall.
  for (const PackedSphere &image : images_in(grain, surface.bounds, 0, box))
    if (surface.overlaps(image)) return false;
  return true;
}

bool WallClearance::is_clear(const PackedSphere &grain, const PeriodicBox &box)
{
  for (Surface &surface : surfaces_)
    if (!is_clear(surface, grain, box)) return false;
  return true;
}

bool WallClearance::is_clear_at_rest(const PackedSphere &grain, const PeriodicBox &box)
{
  for (Surface &surface : surfaces_)
    if (!surface.moves && !is_clear(surface, grain, box)) return false;
  return true;
}

std::size_t WallClearance::bytes() const
{
  std::size_t sum = 0;
  for (const Surface &surface : surfaces_)
    if (surface.search) sum += surface.search->tree.bytes();
  return sum;
}

}    // namespace lsdcd
