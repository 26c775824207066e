// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Moves a mesh by the terms and the servo of its motion, or by poses of the host, or leaves it at rest.
#pragma once

#include "wall/move/mover.h"

namespace lsdcd {

class ScriptedMover final : public Mover {
 public:
  // As Mover; laws must outlive it, too.
  ScriptedMover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const Step &now) :
      Mover(host, wall, mesh, now), controller_(host, wall, laws, mesh)
  {
  }

  void advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load) override;

  Real servo_push(const ServoLoad &load) const override { return controller_.push(load); }
  bool has_servo() const override { return motion().servo().present; }
  bool servo_acts() const override { return controller_.acts(); }

  std::string why_no_motion() const override { return ""; }
  // Throw where the host poses the mesh.
  void set_motion(const RigidMotion &to, const Step &now) override;
  void set_servo(const Servo &to) override;
  // Throws where the host does not pose it.
  void set_pose(const Pose &pose) override;

  std::string servo_text() const override;

  void check(const MeshState &was) const override;
  void restore(const MeshState &was, const Step &now) override;

 private:
  void check_posed(bool posed) const;

  ServoController controller_;
};

}    // namespace lsdcd
