// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments of a command about a servo.
#pragma once

#include "base/input_words.h"
#include "wall/spec/wall_spec.h"

namespace lsdcd {

extern const char *const kServoSyntax;    // what may follow the word servo

// Reads the arguments of the keyword. A variable becomes an input. Throws InputError.
void read_servo(Tokens &w, MeshSpec &s, InputNames &inputs);

// `fix_modify ID servo ...`, or `servo none`, which is not present.
Servo read_modified_servo(Tokens &w, InputNames &inputs);

}    // namespace lsdcd
