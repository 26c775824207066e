// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of a contact law between grains: those of pair_coeff.
#pragma once

#include "input/material_words.h"
#include "pair/pair_coeff.h"

#include <string>
#include <vector>

namespace lsdcd {

// Reads what follows the atom types: NORMAL ... of LAMMPS's pair_style granular, or `law` and a law in the words of the
// wall. Either may have `cutoff C`. Throws InputError.
PairCoeff read_pair_coeff(const std::vector<std::string> &words);

// "pair_coeff I J NORMAL ..., or ..."
std::string pair_coeff_syntax();

// Do the words name a material file? Then read_pair_materials() is called before.
bool has_pair_materials(const std::vector<std::string> &words);
// Returns the words with the numbers of the materials, in LAMMPS's units of this name. Reads the file. Throws InputError.
std::vector<std::string> read_pair_materials(const std::vector<std::string> &words,
                                             const std::string &units, MaterialsRead &read);

}    // namespace lsdcd
