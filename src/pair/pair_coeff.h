// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The law of a pair of atom types as it is given, and mixed from those of two types.
#pragma once

#include "material/material_law.h"

#include <string>
#include <vector>

namespace lsdcd {

struct PairCoeff {
  std::vector<GivenSubModel>
      sub_models;    // a classic style, or `granular`'s with the normal one first
  bool limit_damping = false;
  Real cutoff = -1;      // of the pair, length; below 0: that of the radii
  std::string report;    // of materials, several lines; empty: none
};

// Have they the same sub-models, numbers and cutoff?
bool are_equal(const PairCoeff &a, const PairCoeff &b);
// Throws InputError where the sub-models do not go together.
ContactLaw law_of(const PairCoeff &coeff);
// "granular hertz/material ...": words that give the same law, NULL for numbers that are derived.
std::string text_of(const PairCoeff &coeff);

// Returns the law of two types without one of their own, as LAMMPS means to mix: E* and G* of the two materials, the
// geometric mean of any other number; of a number that is derived on one side, one that is derived. Throws InputError where
// their sub-models differ. `types`: how a message calls them.
PairCoeff mixed(const PairCoeff &a, const PairCoeff &b, const std::string &types);

}    // namespace lsdcd
