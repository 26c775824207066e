// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// How far a sphere is from the walls of the script, where they will be.
#ifndef LSDCD_WALL_CLEARANCE_H
#define LSDCD_WALL_CLEARANCE_H

#include "insert/packing.h"
#include "mesh/periodic_box.h"
#include "motion/motion.h"
#include "query/triangle_tree.h"
#include "wall/mesh_part.h"

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixWallLsdcd;
}

namespace lsdcd {

// Only the process with the meshes, the first one, may ask for distances.
class WallClearance {
 public:
  // Makes a tree for each mesh that is new.
  void follow(const std::vector<const LAMMPS_NS::FixWallLsdcd *> &walls, bool has_meshes);
  // Where the meshes are one timestep after their last one.
  void place(Real dt);

  // Is the sphere's centre at least its radius from every mesh, and from its images?
  bool is_clear(const PackedSphere &sphere, const PeriodicBox &box);
  // The same of meshes that have never moved.
  bool is_clear_at_rest(const PackedSphere &sphere, const PeriodicBox &box);

  std::size_t bytes() const;

 private:
  struct Surface {
    std::string fix;    // its ID
    std::size_t index;
    std::uint64_t fingerprint;
    int shape;    // MeshGrid::shape()
    WeldedMesh mesh;
    TriangleTable names;
    TriangleTree tree;
    Pose pose;
    bool moves = false;    // or was moved
    Box bounds;            // in that pose
    std::uint32_t hint = kNoPrimitive;

    Surface(const std::string &fix, std::size_t index, std::uint64_t fingerprint, int shape,
            const WeldedMesh &from) :
        fix(fix),
        index(index), fingerprint(fingerprint), shape(shape), mesh(from), names(mesh),
        tree(mesh, names)
    {
    }

    void place(const MeshPart &part, Real dt)
    {
      pose = part.motion.pose_in(dt);
      moves = part.moves() || part.wear;
      bounds = placed_bounds(pose, {mesh.report.lo, mesh.report.hi});
    }
  };
  bool has_all(bool has_meshes) const;
  bool is_clear(Surface &surface, const PackedSphere &sphere, const PeriodicBox &box);

  std::vector<const LAMMPS_NS::FixWallLsdcd *> walls_;
  std::deque<Surface> surfaces_;
};

}    // namespace lsdcd

#endif
