// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Poses that a program gives to meshes of a wall, and where bodies are.
#include "api/refusals.h"
#include "api/wall_handle.h"
#include "bodies/read_pose.h"

#include <cstddef>
#include <string>

using namespace lsdcd;

namespace {

void check_posed(const lsdcd_wall &wall, int mesh)
{
  check_mesh(wall, mesh, 0);
  const MeshSpec &spec = wall.in->spec().meshes[static_cast<std::size_t>(mesh)];
  const std::string named = "mesh " + std::to_string(mesh) + ", '" + spec.name + "'",
                    why = wall.in->why_it_takes_no_motion(mesh);
  if (!why.empty()) throw ApiError(LSDCD_ERROR_ARGUMENT, named + ": " + why);
  if (!spec.motion.is_posed())
    throw ApiError(LSDCD_ERROR_ARGUMENT,
                   named + ", is not posed by the caller: say motion caller when the wall is made");
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

int lsdcd_wall_set_pose(lsdcd_wall *wall, int mesh, const double *position,
                        const double *quaternion, const double *velocity,
                        const double *angular_velocity)
{
  return guard_wall(wall, [&] {
    check_posed(*wall, mesh);
    const Pose pose = pose_of(position, quaternion, velocity, angular_velocity);
    wall->in->set_pose(mesh, pose);
    wall->poses.add(mesh, pose);
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

}    // extern "C"
