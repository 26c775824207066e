// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh as a rigid body, as data.
#pragma once

#include "motion/inputs.h"
#include "rigid/joint.h"
#include "rigid/mass_properties.h"

namespace lsdcd {

// Points of a body's surface that feel other meshes.
struct CoatSpec {
  bool present = false;
  Real spacing = 0;    // length; how far points are apart at most; 0: chosen
  Real radius = 0;     // length, of the points; 0: chosen
};

struct BodySpec {
  bool present = false;
  Real density = 0;       // mass/volume, of a closed mesh; 0: the next says what it has
  MassProperties mass;    // in the box, where the mesh is placed
  Joint joint;
  JointDrive drive;
  Vec3 load = {0, 0, 0};      // force at the centre
  Vec3 moment = {0, 0, 0};    // torque
  // Inputs of the host, whose values these are in each step.
  int motor_input = kNoInput, load_input[3] = {kNoInput, kNoInput, kNoInput},
      moment_input[3] = {kNoInput, kNoInput, kNoInput};
  Vec3 velocity = {0, 0, 0}, omega = {0, 0, 0};    // at the start; of the centre
  bool has_gravity = false;                        // false: the host's
  Vec3 gravity = {0, 0, 0};                        // force/mass
  CoatSpec coat;
};

// Throws InputError where no body is so: a moment of inertia, a direction, a range or a word that its joint does not
// have. Parsers and callers without one get the same sentences. Density 0: `mass` is checked.
void check_body(const BodySpec &body);
// Throws InputError where the coordinate of the joint is outside of these limits.
void check_limits(const JointDrive &drive, Real coordinate);

}    // namespace lsdcd
