// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How messages and the log show parts of a WallSpec.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

// "scale 0.001, move 0 0 1"; empty: the mesh is where its file has it.
std::string placement_text(const Placement &placement);

// "rotate 0 0 0 0 0 1 2, linear 1 0 0": kinds with their numbers; an input by its name. Empty: none.
std::string motion_text(const std::vector<MotionTerm> &terms, const InputNames &inputs);

// "force z 100 vmax 0.1"; empty: none.
std::string servo_text(const Servo &servo, const InputNames &inputs);

// "2", "1*3", "2*"; empty: all.
std::string types_text(const LawOfTypes &row);

// "hooke/history", "granular hertz ...": what the log calls the law.
std::string law_name(const LawOfTypes &row);

}    // namespace lsdcd
