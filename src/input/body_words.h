// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments of a command about a rigid body.
#pragma once

#include "base/input_words.h"
#include "wall/spec/wall_spec.h"

namespace lsdcd {

extern const char *const kBodySyntax;    // what may follow the word body

// Reads the arguments of the keyword. Variables become inputs. Throws InputError.
void read_body(Tokens &w, MeshSpec &s, InputNames &inputs);

// Reads the words of fix_modify, from the word body on: what is not named stays as `body` has it. Spring, limits and
// motor of a joint that is replaced go with it. Wall::set_body() checks the numbers.
BodySpec read_modified_body(Tokens &w, const BodySpec &body, InputNames &inputs);

}    // namespace lsdcd
