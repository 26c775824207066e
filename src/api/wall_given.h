// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A caller's structs of a wall as a WallSpec and its parts. Functions throw ApiError, which names the field.
#pragma once

#include "api/lsdcd.h"
#include "motion/motion.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// `on_device`: arrays of spheres are on a device.
WallSpec wall_spec_of(const lsdcd_wall_spec *given, bool on_device);
// `field`: their name in errors.
std::vector<MotionTerm> motions_of(const lsdcd_motion *given, std::size_t n,
                                   const std::string &field);
Servo servo_of(const lsdcd_servo *given, const std::string &field);
// `begins`: with its mass, velocities and coat.
BodySpec body_of(const lsdcd_rigid_body *given, const std::string &field, bool begins);
// `field`: of the twelve numbers.
Placement placement_of(const double *numbers, const std::string &field);

}    // namespace lsdcd
