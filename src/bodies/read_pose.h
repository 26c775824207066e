// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Poses as people give them.
#pragma once

#include "bodies/body_collision.h"

namespace lsdcd {

// Twelve numbers: rows of the rotation matrix, each with its number of the shift. One that is a rotation
// to 1e-6, as floats are, is made one to rounding; else InputError is thrown.
BodyPose pose_of_matrix(const Real *numbers);

// A quaternion w x y z that turns the body about its origin, which goes to `at`. It is made a unit
// one where it is that to 1e-3; else InputError is thrown.
BodyPose pose_of_quaternion(const Vec3 &at, const Real *quaternion);

}    // namespace lsdcd
