// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The velocity of a servo in each step, from the load of the last one.
#pragma once

#include "box/periodic_box.h"
#include "host/host.h"
#include "wall/spec/wall_spec.h"

#include <cstdint>

namespace lsdcd {

// The load of spheres on a mesh in the last step: summed over all processes, and the same on all.
struct ServoLoad {
  Vec3 force = {0, 0, 0};     // on the mesh
  Vec3 torque = {0, 0, 0};    // about the origin of the box
  Real contacts = 0;          // how many
  Real overlap = 0;           // the largest, over the sphere's radius
  // The largest that a contact can have, now or later.
  Real radius = 0;    // length
  Real mass = 0;
  Box extents = {{0, 0, 0}, {0, 0, 0}};    // of the mesh, in its own frame
};

class ServoController {
 public:
  // Controls the servo of this mesh of the wall, counted from 0: wall.meshes[mesh].motion.servo(). Host, wall and laws must outlive this
  // object.
  ServoController(Host &host, WallSpec &wall, const LawTable &laws, int mesh) :
      host_(host), wall_(wall), laws_(laws), mesh_(mesh)
  {
  }

  bool acts() const { return servo().present && !servo().holds; }
  // Returns the force or torque with which the mesh pushes the spheres along the servo's axis, or about it.
  Real push(const ServoLoad &load) const { return servo().push(load.force, load.torque); }

  // Moves a servo that acts over the time `dt` > 0 up to this step. Without the servo the mesh is where `placed` has it. Logs once for each
  // servo its gain, or that the given gain would not be stable, and that a limit stops the servo.
  void advance(const ServoLoad &load, const Pose &placed, Real dt, std::int64_t step);

  // Makes the log have these lines once more, for another servo.
  void begin_anew() { gain_logged_ = limit_warned_ = false; }

 private:
  Servo &servo() const { return wall_.meshes[mesh_].motion.servo(); }
  Real stable_gain(const ServoLoad &load, const Pose &placed, Real dt) const;
  void log_gain(const ServoLoad &load, Real gain, Real dt);

  Host &host_;
  WallSpec &wall_;
  const LawTable &laws_;
  int mesh_;
  bool gain_logged_ = false, limit_warned_ = false;
};

}    // namespace lsdcd
