// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// How far a grain is from the walls of the script, where they will be.
#ifndef LSDCD_WALL_CLEARANCE_H
#define LSDCD_WALL_CLEARANCE_H

#include "box/periodic_box.h"
#include "contact/shape_search.h"
#include "insert/packing.h"
#include "motion/motion.h"
#include "tree/triangle_tree.h"
#include "wall/part/mesh_part.h"

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class FixWallLsdcd;
}

namespace lsdcd {

// Only the process with the meshes, the first one, may ask for distances.
class WallClearance {
 public:
  // Copies each mesh that is new.
  void follow(const std::vector<LAMMPS_NS::FixWallLsdcd *> &walls, bool has_meshes);
  // Makes the meshes of the walls ready for a step, and asks for the shapes that they will have in it. Collective.
  void begin_step();
  // Puts the meshes where they are one timestep after their last one, in those shapes.
  void place(Real dt);

  // Returns whether the grain overlaps no mesh and none of their images.
  bool is_clear(const PackedSphere &grain, const PeriodicBox &box);
  // Returns whether the grain overlaps no mesh that has never moved, and none of their images.
  bool is_clear_at_rest(const PackedSphere &grain, const PeriodicBox &box);

  std::size_t bytes() const;

 private:
  struct Surface {
    struct Search {
      TriangleTable names;
      TriangleTree tree;
      ShapeSearch of_shapes;
      std::uint32_t hint = kNoPrimitive;

      explicit Search(const WeldedMesh &mesh) : names(mesh), tree(mesh, names), of_shapes(tree) {}
    };
    std::string fix;    // its ID
    std::size_t index;
    std::uint64_t fingerprint;
    WeldedMesh mesh;
    std::unique_ptr<Search> search;    // null until a grain is near, since vertices have moved
    Pose pose;
    bool moves = false;    // or was moved
    Box bounds;            // in that pose

    Surface(const std::string &fix, std::size_t index, std::uint64_t fingerprint,
            const WeldedMesh &from) :
        fix(fix),
        index(index), fingerprint(fingerprint), mesh(from)
    {
    }

    void place(const std::vector<Vec3> &vertices, const MeshPart &part, Real dt);
    bool overlaps(const PackedSphere &grain);
  };
  bool has_all(bool has_meshes) const;
  static bool is_clear(Surface &surface, const PackedSphere &grain, const PeriodicBox &box);

  std::vector<LAMMPS_NS::FixWallLsdcd *> walls_;
  std::vector<std::vector<Vec3>> nodes_;    // of each mesh; empty: they do not move
  std::deque<Surface> surfaces_;
};

}    // namespace lsdcd

#endif
