// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// compute lsdcd/collide: rigid bodies of atoms, with a mesh, against the meshes of fix wall/lsdcd.
#ifndef LMP_COMPUTE_COLLIDE_LSDCD_H
#define LMP_COMPUTE_COLLIDE_LSDCD_H

#include "compute.h"

#include "bodies/fit_pose.h"
#include "bodies/mesh_collision.h"
#include "box/periodic_box.h"
#include "input/collide_settings.h"
#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "wall/spec/run_files.h"

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace lsdcd {
struct Pose;
}

namespace LAMMPS_NS {

class ComputeCollideLsdcd : public Compute, protected OwnMessages {
 public:
  ComputeCollideLsdcd(class LAMMPS *, int, char **);
  ~ComputeCollideLsdcd() override;

  void init() override;
  double compute_scalar() override;
  void compute_vector() override;
  void compute_array() override;
  double memory_usage() override;

  std::vector<lsdcd::RunFile> files() const;    // that it has read

 private:
  // An atom of a body, when the compute was defined.
  struct Member {
    tagint molecule, tag;
    lsdcd::Vec3 x;    // unwrapped
  };
  struct Body {
    tagint molecule;
    lsdcd::Vec3 near;    // its atoms are about here
  };
  struct BodyPoint {
    int body, point;
  };
  // A mesh of the wall, against which this process tries bodies. `collision` is null if the process tries none.
  struct Against {
    std::unique_ptr<lsdcd::MeshCollision> collision;
    std::uint64_t fingerprint;    // to know it again
    lsdcd::Box bounds;            // in its own frame
  };

  lsdcd::CollideSettings settings;
  OutputVariables variables;
  std::vector<Body> bodies;
  std::unordered_map<tagint, BodyPoint> body_point_of;    // by an atom's tag
  std::unique_ptr<lsdcd::PosePoints> points;    // that all bodies have, where their mesh is
  lsdcd::Vec3 middle = {0, 0, 0};               // of the mesh, and how far it reaches from there
  double reach = 0;
  std::vector<Against> meshes;
  bigint evaluated_at = -1;
  std::vector<double> found;    // pairs of each body, then pieces that may have missed some

  // compute_collide_lsdcd_bodies.cpp
  void find_bodies();
  std::vector<Member> gather_members() const;
  std::vector<double> gather_sums() const;
  lsdcd::BodyPose pose_of(int, const std::vector<double> &) const;
  std::vector<lsdcd::Vec3> read_points() const;
  std::string name_of(int) const, kind_text() const;

  const class FixWallLsdcd &wall() const;
  void make_collisions(const lsdcd::WeldedMesh &);
  void check_shapes(const FixWallLsdcd &) const;
  void check_wall(const FixWallLsdcd &) const;
  void evaluate();
  void collide(int, const lsdcd::BodyPose &, const FixWallLsdcd &, const lsdcd::PeriodicBox &);
  template <class Visit>
  void for_images(const lsdcd::BodyPose &, const lsdcd::Pose &, const lsdcd::Box &,
                  const lsdcd::PeriodicBox &, const Visit &) const;
  bool is_mine(int) const;
  bool has_any() const;
  void log_mesh(const lsdcd::WeldedMesh &) const;
};

}    // namespace LAMMPS_NS

#endif
