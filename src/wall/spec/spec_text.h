// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How messages and the log show parts of a WallSpec.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns a placement as text, "scale 0.001, move 0 0 1"; empty: the mesh is where its file has it.
std::string placement_text(const Placement &placement);

// Returns the terms of a motion as text, "rotate 0 0 0 0 0 1 2, linear 1 0 0", with inputs by their names; empty: there are none.
std::string motion_text(const std::vector<MotionTerm> &terms, const InputNames &inputs);

// Returns a servo as text, "force z 100 vmax 0.1"; empty: it is not present.
std::string servo_text(const Servo &servo, const InputNames &inputs);

// Returns the types of a row as text, "2", "1*3" or "2*"; empty: all.
std::string types_text(const LawOfTypes &row);

// Returns what the log calls the law of a row: "hooke/history", "granular hertz ...".
std::string law_name(const LawOfTypes &row);

}    // namespace lsdcd
