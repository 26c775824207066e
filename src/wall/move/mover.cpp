// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/mover.h"

#include "base/input_error.h"
#include "wall/spec/mesh_name.h"
#include "wall/spec/spec_text.h"

namespace lsdcd {

Mover::Mover(Host &host, WallSpec &wall, const LawTable &laws, int mesh, const MeshGrid &grid,
             Real force, const Step &now) :
    host_(host),
    wall_(wall), mesh_(mesh), motion_(host, wall, mesh, now), servo_(host, wall, laws, mesh)
{
  if (spec().body.present)
    body_ = std::make_unique<BodyMover>(host, wall, laws, mesh, grid, force, motion_);
}

std::string Mover::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

bool Mover::keeps(const Vec3 &edge, Real width) const
{
  return body_ ? body_->keeps(edge, width) : motion().keeps(edge);
}

Real Mover::known_period() const
{
  return motion_.has_inputs() ? 0 : motion().longest_period();
}

void Mover::check_keeps_plane(const RigidMotion &motion) const
{
  if (host_.box().dimension != 2 || !motion.any() || motion.keeps({0, 0, 1})) return;
  std::string text = motion_text(motion.terms(), wall_.inputs);
  if (motion.servo().present)
    text += (text.empty() ? "servo " : " servo ") + lsdcd::servo_text(motion.servo(), wall_.inputs);
  throw InputError(
      named("in two dimensions a mesh must move in the plane z = 0 and turn about z, not by '" +
            text + "'"));
}

void Mover::check_plane() const
{
  if (body_)
    body_->check_plane();
  else
    check_keeps_plane(motion());
}

void Mover::check_snapshot(const Step &at) const
{
  if (body_)
    body_->check_snapshot();
  else
    motion_.check_snapshot(at);
}

void Mover::advance(const Step &to, const std::vector<Real> &inputs, const LastLoad &load)
{
  if (body_) return body_->advance(to, inputs);
  if (!moves_or_varies()) return;
  const Real passed = motion_.advance(to, inputs);
  if (to.kind == Step::step && passed != 0 && servo_.acts())
    servo_.advance(load(), motion_.pose_without_servo(), passed, to.number);
}

std::string Mover::why_no_motion() const
{
  if (body_)
    return "a body moves by what acts on it, so it cannot have a motion, a servo or a pose";
  return spec().has_nodes
             ? "its nodes alone move this mesh, so it cannot have a motion, a servo or a pose"
             : "";
}

void Mover::check_posed(bool posed) const
{
  const std::string why = why_no_motion();
  if (!why.empty()) throw InputError(named(why));
  if (motion().is_posed() == posed) return;
  throw InputError(
      named(posed ? "the mesh is not one that poses move, and cannot become one later: "
                    "make it so when the wall is made"
                  : "poses alone move this mesh, so it cannot have a motion or a servo"));
}

void Mover::set_motion(const RigidMotion &to, const Step &now)
{
  check_posed(false);
  RigidMotion next = to;
  next.servo() = motion().servo();
  check_keeps_plane(next);
  motion_.set(to, now);
}

void Mover::set_pose(const Pose &pose)
{
  check_posed(true);
  motion().set_pose(pose);
}

void Mover::set_servo(const Servo &to)
{
  check_posed(false);
  RigidMotion next = motion();
  next.servo() = to;
  check_keeps_plane(next);
  motion_.set(to);
  servo_.begin_anew();
}

std::string Mover::servo_text() const
{
  return lsdcd::servo_text(motion().servo(), wall_.inputs);
}

void Mover::save(MeshState &to) const
{
  to.motion = motion_.state();
  if (body_) body_->save(to);
}

void Mover::check(const MeshState &was) const
{
  if (!spec().has_nodes) motion_.check(was.motion);
  if (body_) body_->check(was);
}

void Mover::restore(const MeshState &was, const Step &now)
{
  const std::string saved = host_.names().saved;
  if (spec().has_nodes) {
    if (is_same_place(was.motion.last, Pose())) return;
    host_.warn(named("the " + saved +
                     " was written when something else moved this mesh, and now its nodes do: they "
                     "begin at the vertices of its file"));
    return;
  }
  motion_.restore(was.motion, now);
  if (body_) return body_->restore(was.body);
  if (!was.body.present && !(was.motion.was_posed() && !motion().is_posed())) return;
  host_.warn(named("the " + saved +
                   (was.body.present ? " has a body" : " has a pose of the program") +
                   " for this mesh, and " + host_.names().wall +
                   " has none: the mesh goes on from where it was"));
}

}    // namespace lsdcd
