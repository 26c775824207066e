// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// One mesh of fix wall/lsdcd: its settings and grid, where it is, and what was done to it.
#ifndef LMP_MESH_PART_H
#define LMP_MESH_PART_H

#include "lammps/mpi_wall.h"
#include "mesh/point_tree.h"
#include "output/mesh_image.h"
#include "wall/mesh_motion.h"
#include "wall/servo_controller.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

struct MeshPart {
  // Of the mesh with this number of the wall, as an engine counts them.
  MeshPart(MPI_Comm world, lsdcd::Host &host, lsdcd::WallSettings &all, int index,
           const lsdcd::Step &now) :
      index(index),
      settings(all.meshes[index]), wall(world, all, settings), motion(host, all, index, now),
      servo_controller(host, all, index, bounds(0))
  {
  }

  const int index;
  lsdcd::MeshSettings &settings;    // in those of the wall; fix_modify changes its motion
  lsdcd::SharedWall wall;
  lsdcd::MeshMotion motion;
  lsdcd::ServoController servo_controller;

  std::vector<lsdcd::ImageObject> strokes;    // of its picture; on the first process

  std::unique_ptr<lsdcd::PointTree> vertices;    // of a process that has the mesh; once asked for

  bool out_of_reach_warned = false, ends_warned = false;
  bool was_in_box = false, gone_warned = false;    // of a mesh that moves
  bool springs_are_foreign = false;                // those of a restart file are of another mesh

  const lsdcd::Servo &servo() const { return settings.motion.servo(); }

  lsdcd::Box bounds(double past) const;    // in its own frame
  // From where to where its vertices go along edge k of the box at a pose, as parts of the box. Collective.
  void find_range(const lsdcd::PeriodicBox &box, int k, const lsdcd::WallPose &at, double &lo,
                  double &hi);
  // Whether it looks the same from each of its images across the faces that edge k joins.
  bool keeps_edge(const lsdcd::PeriodicBox &box, int k) const;
  lsdcd::PeriodicBox box_seen(const lsdcd::PeriodicBox &box) const;    // from its own frame
};

}    // namespace LAMMPS_NS

#endif
