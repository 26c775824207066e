// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/scripted_mover.h"

#include "base/input_error.h"
#include "wall/spec_text.h"

namespace lsdcd {

void ScriptedMover::advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load)
{
  if (!moves_or_varies()) return;
  const Real passed = motion_.advance(to, inputs);
  if (to.kind == Step::step && passed != 0 && controller_.acts())
    controller_.advance(load(), motion_.pose_without_servo(), passed, to.number);
}

void ScriptedMover::check_posed(bool posed) const
{
  if (motion().is_posed() == posed) return;
  throw InputError(
      named(posed ? "the mesh is not one that poses move, and cannot become one later: "
                    "make it so when the wall is made"
                  : "poses alone move this mesh, so it cannot have a motion or a servo"));
}

void ScriptedMover::set_motion(const RigidMotion &to, const Step &now)
{
  check_posed(false);
  RigidMotion next = to;
  next.servo() = motion().servo();
  check_keeps_plane(next);
  motion_.set(to, now);
}

void ScriptedMover::set_pose(const Pose &pose)
{
  check_posed(true);
  motion().set_pose(pose);
}

void ScriptedMover::set_servo(const Servo &to)
{
  check_posed(false);
  RigidMotion next = motion();
  next.servo() = to;
  check_keeps_plane(next);
  motion_.set(to);
  controller_.begin_anew();
}

std::string ScriptedMover::servo_text() const
{
  return lsdcd::servo_text(motion().servo(), wall_.inputs);
}

void ScriptedMover::check(const MeshState &was) const
{
  motion_.check(was.motion);
}

void ScriptedMover::restore(const MeshState &was, const Step &now)
{
  motion_.restore(was.motion, now);
  if (!was.body.present && !(was.motion.was_posed() && !motion().is_posed())) return;
  host_.warn(named("the " + std::string(host_.names().saved) +
                   (was.body.present ? " has a body" : " has a pose of the program") +
                   " for this mesh, and " + host_.names().wall +
                   " has none: the mesh goes on from where it was"));
}

}    // namespace lsdcd
