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
//   granular [hertz/material | jkr | dmt] material FILE PARTICLE [on WALL]
//     [with [MATERIAL] KEY VALUE ...]
// numbers take the place of `material ...`, and NULLs that sub-models after it have for
// friction, rolling friction and conductivity are filled in; other words come back as they
// are. `units`: the deck's system of units, by LAMMPS's name. The modulus and Poisson's
// ratio of two materials are those of one that, on both sides as LAMMPS's walls take it,
// gives their effective Young's and shear moduli. Throws InputError, in `words` of where the
// tokens come from.
FilledTokens fill_material(const std::vector<std::string> &tokens, const std::string &units,
                           const MaterialWords &words = kDeckWords);

// The same material's contact with itself in the words of LAMMPS's `pair_style granular` as
// 29Sep2021 has them, which later ones take too: `granular` left out, tsuji with the number that
// gives the restitution for coeff_restitution, and no damping as a velocity's of 0.
std::vector<std::string> words_of_29sep2021(std::vector<std::string> filled);

}    // namespace lsdcd
