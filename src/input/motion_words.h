// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Words of a script that say how a mesh moves.
#pragma once

#include "base/input_words.h"
#include "input/settings.h"

#include <string>
#include <vector>

namespace lsdcd {

extern const char *const kMotionSyntax;    // what may follow the word motion

// These read what follows a keyword of the fix. They throw InputError.
void read_motion(Tokens &w, MeshSettings &s);
void read_wiggle(Tokens &w, MeshSettings &s);    // those of fix wall/gran: cosine,
void read_shear(Tokens &w, MeshSettings &s);     // and a velocity of a wall that stays where it is
void read_surface_vel(Tokens &w, MeshSettings &s);
void read_surface_angvel(Tokens &w, MeshSettings &s);

// `fix_modify ID motion ... [motion ...]`, or `motion none`. `taken`: how many words that is.
struct ModifiedMotion {
  std::vector<MotionTerm> terms;
  std::string text;    // as a log shows it; empty: none
  std::size_t taken = 0;
};
ModifiedMotion read_modified_motion(const std::vector<std::string> &tokens);

}    // namespace lsdcd
