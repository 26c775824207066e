// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "bodies/read_pose.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "bodies/check_body.h"

#include <cmath>

namespace lsdcd {

namespace {

void check_finite(const Real *numbers, int n, const char *what)
{
  for (int k = 0; k < n; k++)
    if (!std::isfinite(numbers[k]))
      throw InputError(std::string("the pose's ") + what + " is not finite: number " +
                       std::to_string(k + 1) + " is " + number_text(numbers[k]));
}

// Newton's steps to the nearest rotation. Each squares the error; a rotation stays as it is.
void make_rotation(BodyPose &pose)
{
  constexpr Real kOfDoubles = 1e-14;
  while (!is_orthogonal(pose, kOfDoubles)) {
    const BodyPose old = pose;
    for (int i = 0; i < 3; i++) {
      pose.row[i] = Real(1.5) * old.row[i];
      for (int j = 0; j < 3; j++)
        pose.row[i] -= Real(0.5) * dot(old.row[i], old.row[j]) * old.row[j];
    }
  }
}

}    // namespace

BodyPose pose_of_matrix(const Real *numbers)
{
  check_finite(numbers, 12, "matrix");
  BodyPose pose;
  for (int i = 0; i < 3; i++) {
    pose.row[i] = {numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]};
    pose.shift[i] = numbers[4 * i + 3];
  }
  check_rotation(pose, 1e-6);
  make_rotation(pose);
  return pose;
}

BodyPose pose_of_quaternion(const Vec3 &at, const Real *quaternion)
{
  const Real place[3] = {at.x, at.y, at.z};
  check_finite(place, 3, "position");
  check_finite(quaternion, 4, "quaternion");
  Real length = 0;
  for (int k = 0; k < 4; k++) length += quaternion[k] * quaternion[k];
  length = std::sqrt(length);
  if (!(std::fabs(length - 1) <= 1e-3))
    throw InputError("the pose's quaternion has the length " + number_text(length) +
                     ": give a unit one, w x y z");
  const Real w = quaternion[0] / length, x = quaternion[1] / length, y = quaternion[2] / length,
             z = quaternion[3] / length;
  BodyPose pose;
  pose.row[0] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)};
  pose.row[1] = {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)};
  pose.row[2] = {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
  pose.shift = at;
  return pose;
}

}    // namespace lsdcd
