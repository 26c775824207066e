// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a moving mesh is, and how fast it goes: x_box = turn x_mesh + shift.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct Pose {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};    // of the rotation matrix
  Vec3 shift = {0, 0, 0};                             // length; where the mesh's origin is
  // Velocity of the mesh's origin, and angular velocity (right-handed), both in the frame of the box.
  Vec3 velocity = {0, 0, 0};    // length/time
  Vec3 angular = {0, 0, 0};     // 1/time
  // How velocity and angular change: by turning, their derivatives; by a motion whose speed varies, such that the velocity less half a step's
  // acceleration is the mean velocity of the step. The speed of a servo is that of the step and has no change.
  Vec3 acceleration = {0, 0, 0};    // length/time^2
  Vec3 spin_up = {0, 0, 0};         // 1/time^2
  bool placed = false;              // false: the mesh is where its file puts it, and stays there

  // Turn a vector from one frame to the other.
  LSDCD_FN Vec3 turn_to_box(const Vec3 &a) const
  {
    return placed ? Vec3{dot(row[0], a), dot(row[1], a), dot(row[2], a)} : a;
  }
  LSDCD_FN Vec3 turn_to_mesh(const Vec3 &a) const
  {
    return placed ? a.x * row[0] + a.y * row[1] + a.z * row[2] : a;
  }
  // Transform a point from one frame to the other.
  LSDCD_FN Vec3 to_box(const Vec3 &x) const { return placed ? turn_to_box(x) + shift : x; }
  LSDCD_FN Vec3 to_mesh(const Vec3 &x) const { return placed ? turn_to_mesh(x - shift) : x; }

  // Returns this pose at rest.
  Pose still() const
  {
    Pose pose = *this;
    pose.velocity = pose.angular = pose.acceleration = pose.spin_up = {0, 0, 0};
    return pose;
  }

  // Returns the velocity of the point x of the mesh, both in the mesh's frame.
  LSDCD_FN Vec3 velocity_in_mesh(const Vec3 &x) const
  {
    return turn_to_mesh(velocity) + cross(turn_to_mesh(angular), x);
  }
};

// Returns whether two poses have the mesh at the same place, whatever their velocities.
inline bool is_same_place(const Pose &a, const Pose &b)
{
  return a.row[0] == b.row[0] && a.row[1] == b.row[1] && a.row[2] == b.row[2] && a.shift == b.shift;
}

}    // namespace lsdcd
