// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arguments of a command that say how a mesh moves.
#pragma once

#include "base/input_words.h"
#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

extern const char *const kMotionSyntax;    // what may follow the word motion

// These read the arguments of a keyword of the fix. Variables become inputs. They throw InputError.
void read_motion(Tokens &w, MeshSpec &s, InputNames &inputs);
// Those of fix wall/gran: cosine, and a velocity of a wall that stays where it is.
void read_wiggle(Tokens &w, MeshSpec &s, InputNames &);
void read_shear(Tokens &w, MeshSpec &s, InputNames &inputs);
void read_surface_vel(Tokens &w, MeshSpec &s, InputNames &inputs);
void read_surface_angvel(Tokens &w, MeshSpec &s, InputNames &inputs);

// `fix_modify ID motion ... [motion ...]`, or `motion none`, which has no terms.
RigidMotion read_modified_motion(Tokens &w, InputNames &inputs);

}    // namespace lsdcd
