// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd_place_*, and how meshes of a wall move.
#include "api/refusals.h"
#include "api/wall_given.h"
#include "api/wall_handle.h"
#include "bodies/read_pose.h"
#include "mesh/placement.h"

#include <cstddef>
#include <functional>
#include <string>

using namespace lsdcd;

namespace {

// A placement in a caller's twelve numbers.
void change_placement(double *numbers, const std::function<void(Placement &)> &change)
{
  need(numbers, "placement");
  Placement placement = placement_of(numbers, "placement");
  change(placement);
  for (int k = 0; k < 3; k++) {
    for (int d = 0; d < 3; d++) numbers[4 * k + d] = placement.row(k)[d];
    numbers[4 * k + 3] = placement.shift()[k];
  }
}

void check_posed(const lsdcd_wall &wall, int mesh, bool wanted)
{
  check_mesh(wall, mesh, 0);
  const MeshSpec &spec = wall.in->spec().meshes[static_cast<std::size_t>(mesh)];
  const std::string named = "mesh " + std::to_string(mesh) + ", '" + spec.name + "'",
                    why = wall.in->why_it_takes_no_motion(mesh);
  if (!why.empty()) throw ApiError(LSDCD_ERROR_ARGUMENT, named + ": " + why);
  if (spec.motion.is_posed() == wanted) return;
  throw ApiError(LSDCD_ERROR_ARGUMENT,
                 named + ", is " +
                     (wanted ? "not posed by the caller: say motion caller when "
                               "the wall is made"
                             : "posed by the caller: lsdcd_wall_set_pose() moves it"));
}

void check_is_body(const lsdcd_wall &wall, int mesh)
{
  check_mesh(wall, mesh, 0);
  const MeshSpec &spec = wall.in->spec().meshes[static_cast<std::size_t>(mesh)];
  if (!spec.body.present)
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   "mesh " + std::to_string(mesh) + ", '" + spec.name +
                       "', is not a body: say body ... when the wall is made");
}

// Null: the default of each.
Pose pose_of(const double *position, const double *quaternion, const double *velocity,
             const double *angular_velocity)
{
  Pose pose;
  pose.placed = true;
  if (position) pose.shift = checked_vector(position, "position");
  if (velocity) pose.velocity = checked_vector(velocity, "velocity");
  if (angular_velocity) pose.angular = checked_vector(angular_velocity, "angular_velocity");
  if (!quaternion) return pose;
  for (std::size_t k = 0; k < 4; k++) checked_number(quaternion[k], element("quaternion", k));
  try {
    const BodyPose turned = pose_of_quaternion(pose.shift, quaternion);
    for (int k = 0; k < 3; k++) pose.row[k] = turned.row[k];
  } catch (const InputError &e) {
    throw ApiError(LSDCD_ERROR_ARGUMENT, e.what());
  }
  return pose;
}

}    // namespace

extern "C" {

int lsdcd_place_scale(double *placement, double x, double y, double z)
{
  return guard([&] { change_placement(placement, [&](Placement &p) { p.scale({x, y, z}); }); });
}

int lsdcd_place_rotate(double *placement, const double *axis, double degrees)
{
  return guard([&] {
    need(axis, "axis");
    change_placement(placement, [&](Placement &p) {
      p.rotate({axis[0], axis[1], axis[2]}, degrees);
    });
  });
}

int lsdcd_place_move(double *placement, double x, double y, double z)
{
  return guard([&] { change_placement(placement, [&](Placement &p) { p.move({x, y, z}); }); });
}

int lsdcd_wall_set_pose(lsdcd_wall *wall, int mesh, const double *position,
                        const double *quaternion, const double *velocity,
                        const double *angular_velocity)
{
  return guard_wall(wall, [&] {
    check_posed(*wall, mesh, true);
    const Pose pose = pose_of(position, quaternion, velocity, angular_velocity);
    wall->in->set_pose(mesh, pose);
    wall->poses.add(mesh, pose);
  });
}

int lsdcd_wall_set_motion(lsdcd_wall *wall, int mesh, const lsdcd_motion *motions, size_t n)
{
  return guard_wall(wall, [&] {
    check_posed(*wall, mesh, false);
    RigidMotion motion;
    for (const MotionTerm &term : motions_of(motions, n, "motions")) motion.add(term);
    note_late(*wall);
    wall->in->set_motion(mesh, motion, {wall->number, wall->dt});
  });
}

int lsdcd_wall_set_servo(lsdcd_wall *wall, int mesh, const lsdcd_servo *servo)
{
  return guard_wall(wall, [&] {
    check_posed(*wall, mesh, false);
    note_late(*wall);
    wall->in->set_servo(mesh, servo ? servo_of(servo, "servo") : Servo());
  });
}

int lsdcd_wall_get_body(lsdcd_wall *wall, int mesh, lsdcd_body_state *state)
{
  return guard_wall(wall, [&] {
    lsdcd_body_state out = checked(state, "lsdcd_body_state");
    check_is_body(*wall, mesh);
    tell_late(*wall);
    const BodyMover &of = *wall->in->body(mesh);
    const RigidBody &body = of.rigid();
    const Wrench reaction = of.reaction();
    const auto put = [](const Vec3 &v, double *to) {
      for (int k = 0; k < 3; k++) to[k] = v[k];
    };
    put(body.centre(), out.centre);
    out.quaternion[0] = body.turn().w;
    put(body.turn().v, out.quaternion + 1);
    put(body.velocity(), out.velocity);
    put(body.omega(), out.angular_velocity);
    put(reaction.force, out.reaction_force);
    put(reaction.torque, out.reaction_torque);
    out.coordinate = body.coordinate();
    out.energy = of.spring_and_kinetic_energy();
    out.stop_force = of.stop_force();
    copy_out(out, state);
  });
}

int lsdcd_wall_set_body(lsdcd_wall *wall, int mesh, const lsdcd_rigid_body *body)
{
  return guard_wall(wall, [&] {
    check_is_body(*wall, mesh);
    need(body, "body");
    const BodySpec to = body_of(body, "body", false);
    note_late(*wall);
    try {
      wall->in->set_body(mesh, to);
    } catch (const InputError &e) {
      throw ApiError(LSDCD_ERROR_ARGUMENT, e.what());
    }
  });
}

}    // extern "C"
