// One mesh of fix wall/lsdcd: its settings and grid, where it is, and what was done to it.
#ifndef LMP_MESH_PART_H
#define LMP_MESH_PART_H

#include "lammps/mpi_wall.h"
#include "lmptype.h"
#include "mesh/point_tree.h"
#include "output/mesh_image.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// Time goes on by one step in each step, whatever the timestep, and whatever number
// reset_timestep gives the step: base at base_step, and dt for each step since.
struct StepClock {
  lsdcd::Time base;
  bigint base_step, step;    // step: the last one
  double dt;
  lsdcd::Time now() const { return base + lsdcd::Time(step - base_step) * dt; }
  void advance(const class Update &);
  // To a step that no run led to: time is what it would be there, with this timestep.
  void jump_to(const class Update &);
};

struct MeshPart {
  MeshPart(MPI_Comm world, const lsdcd::WallSettings &all, int index) :
      index(index), settings(all.meshes[index]), wall(world, all, settings)
  {
  }

  const int index;                 // of the wall's meshes, as an engine counts them
  lsdcd::MeshSettings settings;    // with the motion that fix_modify has given it
  lsdcd::SharedWall wall;

  StepClock clock;                               // of its motion
  lsdcd::WallPose pose;                          // of the step
  lsdcd::SurfaceMotion surface;                  // of the step, where variables give it
  bool gain_told = false, limit_told = false;    // of a servo

  std::vector<lsdcd::Stroke> strokes;    // of its picture; on the first process

  // Over all processes, of the last step: force, torque, contacts, largest overlap, uncertified.
  static constexpr int kTotals = 9;
  double totals[kTotals] = {0}, power = 0, energy = 0;
  lsdcd::Vec3 torque_at_origin = {0, 0, 0};
  void finish_totals();    // from sums about the origin

  std::unique_ptr<lsdcd::PointTree> vertices;    // of a process that has the mesh; once asked for

  bool out_of_reach_warned = false, ends_warned = false;
  bool was_in_box = false, gone_warned = false;    // of a mesh that moves
  bool springs_are_foreign = false;                // those of a restart file are of another mesh

  lsdcd::Servo &servo() { return settings.motion.servo(); }
  const lsdcd::Servo &servo() const { return settings.motion.servo(); }
  bool moves_or_varies() const { return settings.motion.any() || settings.surface_varies(); }
  bool has_variables() const;
  bool takes_differences() const;    // for velocities that its variables do not give

  lsdcd::Box bounds(double past) const;    // in its own frame
  // From where to where its vertices go along edge k of the box at a pose, as parts of the box. Collective.
  void find_range(const lsdcd::PeriodicBox &box, int k, const lsdcd::WallPose &at, double &lo,
                  double &hi);
  // Whether it looks the same from each of its images across the faces that edge k joins.
  bool keeps_edge(const lsdcd::PeriodicBox &box, int k) const;
  lsdcd::PeriodicBox box_seen(const lsdcd::PeriodicBox &box) const;    // from its own frame

  std::string motion_text() const;    // a line for the log

  // What a restart file keeps of its motion: a number of numbers, all as doubles.
  std::vector<double> motion_data() const;
};

}    // namespace LAMMPS_NS

#endif
