// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of the coats of bodies on a mesh.
#pragma once

#include "rigid/step_limit.h"

#include <cstdint>

namespace lsdcd {

// The contacts of coats with one mesh in a step: of its own coat with other meshes, and of their coats with it.
struct CoatLoad {
  Vec3 force = {0, 0, 0};               // on the mesh
  Vec3 torque_at_origin = {0, 0, 0};    // likewise, about the origin of the box
  Real energy = 0;                      // elastic; it counts with the mesh that is touched
  Real contacts = 0;                    // how many
  Real overlap = 0;                     // the largest overlap / radius
  Real radius = 0, mass = 0;            // the largest radius and mass of a contact
  // Where the mesh is a body, in its frame; and bounds of largest() of these.
  ContactSum stiffness, damping;
  ModeRates most;
  std::uint32_t bodies = 0;    // that it touches: a bit for each mesh
};

}    // namespace lsdcd
