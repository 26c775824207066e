// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact style arguments from a material file.
#pragma once

#include "input/material_command.h"

#include <string>
#include <vector>

namespace lsdcd {

struct FilledTokens {
  std::vector<std::string> tokens;    // with numbers where `material` stood
  std::string report;                 // several lines: each number with its source; empty: none
};

// `tokens` begin with FSTYLE. Where they are
//   granular [hertz/material | jkr | dmt] material FILE PARTICLE [types I PARTICLE ...] [on WALL]
//     [with [MATERIAL] KEY VALUE ...] ... mesh FILE [material WALL [with ...]] ...
// numbers replace `material ...`, and NULLs of later sub-models for friction, rolling
// friction and conductivity are filled in. `types`, and `material` of a mesh, become `law`. Other words come back as they are. `units`: the
// script's system of units, by LAMMPS's name. LAMMPS's walls take one material for both
// sides, so that for two materials the modulus and Poisson's ratio are those of one with
// the same effective Young's and shear moduli. Throws InputError, with `words` for the
// place of the tokens.
FilledTokens fill_material(const std::vector<std::string> &tokens, const std::string &units,
                           const MaterialWords &words = kScriptWords);

// Returns the contact of the material with itself, in the words of LAMMPS 29Sep2021's `pair_style granular`, which later
// versions take, too: without `granular`, with tsuji and its number in place of coeff_restitution, and with a velocity
// damping of 0 in place of none.
std::vector<std::string> words_of_29sep2021(std::vector<std::string> filled);

}    // namespace lsdcd
