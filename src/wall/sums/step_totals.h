// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of spheres and coats on the meshes of a wall in the last step: sums over all processes.
#pragma once

#include "engine/engine.h"
#include "host/host.h"
#include "wall/spec/wall_spec.h"
#include "wall/sums/coat_load.h"

#include <vector>

namespace lsdcd {

// The sums of one mesh.
struct MeshTotals {
  Vec3 force = {0, 0, 0};               // on the mesh
  Vec3 torque = {0, 0, 0};              // on the mesh, about the point of MeshSpec::torque_about
  Vec3 torque_at_origin = {0, 0, 0};    // on the mesh, about the origin of the box
  Vec3 couple = {0, 0, 0};              // on the mesh, which no node of it gets; 0 without nodes
  Real contacts = 0;                    // how many, of spheres
  Real overlap = 0;                     // the largest overlap / radius, of spheres
  Real uncertified = 0;                 // spheres whose answer was not certified exact
  Real power = 0;                       // of the mesh on what touches it, by its motion
  Real energy = 0;                      // elastic, in overlaps and springs
};

// What the nodes of a mesh do, if they move.
struct NodeLoad {
  bool present = false;    // the mesh has nodes
  Real power = 0;          // on the spheres of this process, by their motion
  Vec3 moment = {
      0, 0,
      0};    // of the forces of contacts on them, of all processes, about the origin of the box
};

// Returns what the contacts of this process did to mesh k of a wall in a step; nothing if `results` is null, because there are no spheres.
WallTotals totals_of_mesh(StepResults *results, const WallSpec &wall, int k);
// Returns the point (length, of the box) about which the torque on a mesh at this pose is told.
inline Vec3 torque_point(const MeshSpec &mesh, const Pose &pose)
{
  return mesh.torque_about_mesh ? pose.to_box(mesh.torque_about) : mesh.torque_about;
}

// Sums are made when they are asked for: one message in a step, and only in some steps.
class StepTotals {
 public:
  // Both arguments must outlive this object.
  StepTotals(Host &host, const WallSpec &settings) :
      host_(host), settings_(settings), meshes_(settings.meshes.size())
  {
  }

  // Notes that a step was computed, so that its sums are not made yet.
  void expire() { reduced_ = false; }
  // Sets all sums to 0 until the next step, because the wall acts on nothing.
  void clear();
  // Sets the sums of a mesh to those of a saved state, until the next step.
  void restore(int mesh, const MeshTotals &was) { meshes_[mesh] = was; }

  bool are_made() const { return reduced_; }    // of the last step
  // Makes the sums, once a step. `results`: null while there are no spheres. `poses`: of the meshes in
  // this step. `nodes`: of each mesh; empty: none have nodes. `coats`: of each
  // mesh, the same on all processes; null: there are none. Collective.
  void reduce(StepResults *results, const std::vector<Pose> &poses,
              const std::vector<NodeLoad> &nodes = {},
              const std::vector<CoatLoad> *coats = nullptr);
  // Sets the power of a mesh that is a body, by its pose with the velocities of the whole step, once these are known.
  void set_power(int mesh, const Pose &pose);
  // Sets the power of a mesh whose nodes move, once their velocities of the whole step are known.
  void set_power(int mesh, Real power) { meshes_[mesh].power = power; }

  // Returns the sums of the last reduce().
  const MeshTotals &mesh(int k) const { return meshes_[k]; }
  // Returns the totals over all meshes: sums, and the largest overlap. Torques are about the origin of the box if the meshes have their
  // torques about different points.
  MeshTotals of_all() const;

 private:
  Host &host_;
  const WallSpec &settings_;
  std::vector<MeshTotals> meshes_;
  bool reduced_ = false;
};

}    // namespace lsdcd
