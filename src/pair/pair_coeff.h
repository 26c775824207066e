// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The law of a pair of atom types, as it is given or mixed from the laws of two types.
#pragma once

#include "material/material_law.h"

#include <string>
#include <vector>

namespace lsdcd {

struct PairCoeff {
  std::vector<GivenSubModel>
      sub_models;    // a classic style, or `granular`'s with the normal one first
  bool limit_damping = false;
  Real cutoff = -1;      // of the pair, length; below 0: the sum of the radii
  std::string report;    // on materials, several lines; empty: none
};

// Returns whether both have the same sub-models, numbers and cutoff.
bool are_equal(const PairCoeff &a, const PairCoeff &b);
// Returns the law, of grains that are `coarse_grain` times as large as those that the numbers are of. Throws InputError if the
// sub-models do not go together, or are not known for larger grains.
ContactLaw law_of(const PairCoeff &coeff, Real coarse_grain = 1);
// Returns words that give the same law, as "granular hertz/material ...", with NULL for numbers that are derived.
std::string text_of(const PairCoeff &coeff);

// Returns the law of two types that have no law together, mixed as LAMMPS intends: E* and G* of the two materials; for any
// other number the mean that its row says (Mixing), which for most is the geometric one; for a number that is derived on one side, one that is derived. Throws InputError if the
// sub-models differ. `types`: the name of the pair in messages.
PairCoeff mixed(const PairCoeff &a, const PairCoeff &b, const std::string &types);

}    // namespace lsdcd
