// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the coats of bodies do to meshes in a step.
#pragma once

#include "engine/results/step_results.h"
#include "rigid/step_limit.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// The contacts of coats with one mesh in a step: of its own coat with other meshes, and of their coats with it.
struct CoatLoad {
  Vec3 force = {0, 0, 0};               // on the mesh
  Vec3 torque_at_origin = {0, 0, 0};    // on the mesh, about the origin of the box
  Real energy = 0;                      // elastic; it counts with the mesh that is touched
  Real contacts = 0;                    // how many
  Real overlap = 0;                     // the largest overlap / radius
  Real radius = 0, mass = 0;            // the largest radius and mass of a contact
  // Set if the mesh is a body: sums in its frame, and bounds of their largest().
  ContactSum stiffness, damping;
  ModeRates most;
  std::uint32_t bodies = 0;    // that it touches: a bit for each mesh
};

// What the contacts of all coats do with energy in a step.
struct CoatEnergy {
  std::vector<EnergyRows> rows;         // of each mesh
  std::vector<EnergyRecord> records;    // where triangles have them
};

// What the contacts of all coats would do to each mesh if each pushed with a force of 1, by the mesh that it is with.
class CoatPushes {
 public:
  struct Push {
    Vec3 force = {0, 0, 0}, torque_at_origin = {0, 0, 0};    // on the mesh, in the frame of the box
    int contacts = 0;
  };

  explicit CoatPushes(std::size_t meshes) : meshes_(meshes), all_(meshes * meshes) {}

  const Push &on(int mesh, int by) const { return all_[mesh * meshes_ + by]; }
  // Adds a contact at the place x, whose unit normal points from one mesh to the other.
  void add(int from, int to, const Vec3 &x, const Vec3 &normal)
  {
    add_to(all_[to * meshes_ + from], x, normal);
    add_to(all_[from * meshes_ + to], x, -normal);
  }

 private:
  static void add_to(Push &push, const Vec3 &x, const Vec3 &normal)
  {
    push.force += normal;
    push.torque_at_origin += cross(x, normal);
    push.contacts++;
  }

  std::size_t meshes_;
  std::vector<Push> all_;
};

}    // namespace lsdcd
