// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/move/mover.h"

#include "base/input_error.h"
#include "wall/mesh_name.h"
#include "wall/move/body_mover.h"
#include "wall/move/scripted_mover.h"
#include "wall/spec_text.h"

namespace lsdcd {

namespace {

// Of a mesh whose nodes move: nothing moves it as a whole.
class RestingMover final : public Mover {
 public:
  using Mover::Mover;

  std::string why_no_motion() const override
  {
    return "its nodes alone move this mesh, so it cannot have a motion, a servo or a pose";
  }

  void restore(const MeshState &was, const Step & /* now */) override
  {
    if (is_same_place(was.motion.last, Pose())) return;
    host_.warn(named("the " + std::string(host_.names().saved) +
                     " was written when something else moved this mesh, and now its nodes do: they "
                     "begin at the vertices of its file"));
  }
};

}    // namespace

std::unique_ptr<Mover> make_mover(Host &host, WallSpec &wall, const LawTable &laws, int mesh,
                                  const MeshGrid &grid, Real force, const Step &now)
{
  const MeshSpec &spec = wall.meshes[mesh];
  if (spec.body.present)
    return std::make_unique<BodyMover>(host, wall, laws, mesh, grid, force, now);
  if (spec.has_nodes) return std::make_unique<RestingMover>(host, wall, mesh, now);
  return std::make_unique<ScriptedMover>(host, wall, laws, mesh, now);
}

std::string Mover::named(const std::string &text) const
{
  return with_mesh_name(wall_, mesh_, text);
}

bool Mover::keeps(const Vec3 &edge, Real /* width */) const
{
  return motion().keeps(edge);
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

void Mover::advance(const Step &to, const std::vector<Real> &inputs, const LastLoad & /* load */)
{
  if (moves_or_varies()) motion_.advance(to, inputs);
}

void Mover::check_takes_motion() const
{
  const std::string why = why_no_motion();
  if (!why.empty()) throw InputError(named(why));
}

void Mover::check_is_body() const
{
  throw InputError(named("the mesh is not a body, and cannot become one later: make it a body when "
                         "the wall is made"));
}

void Mover::set_motion(const RigidMotion & /* to */, const Step & /* now */)
{
  check_takes_motion();
}

void Mover::set_servo(const Servo & /* to */)
{
  check_takes_motion();
}

void Mover::set_pose(const Pose & /* pose */)
{
  check_takes_motion();
}

void Mover::set_body(const BodySpec & /* to */)
{
  check_is_body();
}

void Mover::save(MeshState &to) const
{
  to.motion = motion_.state();
}

}    // namespace lsdcd
