// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Poses from numbers of a user.
#pragma once

#include "bodies/body_collision.h"

namespace lsdcd {

// Twelve numbers: the rows of a rotation matrix, each followed by a component of the shift. A matrix that
// is a rotation to 1e-6, as in float, is corrected; else it throws InputError.
BodyPose pose_of_matrix(const Real *numbers);

// A quaternion w x y z that turns the body about its origin, which goes to `at`. It is normalised if its
// length is 1 to 1e-3; else it throws InputError.
BodyPose pose_of_quaternion(const Vec3 &at, const Real *quaternion);

}    // namespace lsdcd
