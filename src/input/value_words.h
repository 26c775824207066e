// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Vectors, and numbers that may be a host's variables, in the words of a wall.
#pragma once

#include "base/input_words.h"
#include "base/vec3.h"
#include "motion/inputs.h"

#include <string>

namespace lsdcd {

// Three numbers, with these names in messages.
Vec3 read_vector(Tokens &w, const char *x, const char *y, const char *z);

// Is the next word v_NAME?
bool variable_follows(const Tokens &w);
// NAME of the next word, which is v_NAME.
std::string take_variable(Tokens &w);

// A number, or v_NAME, which becomes an input: then `value` is 0. `what`: its name in messages.
void read_value(Tokens &w, const std::string &what, Real &value, int &input, InputNames &inputs);
void read_values(Tokens &w, const char *const (&names)[3], Vec3 &values, int (&input)[3],
                 InputNames &inputs);

}    // namespace lsdcd
