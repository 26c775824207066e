// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Coarse graining: one grain that is L times as large stands for L^3 grains. Density, velocities and stresses stay, so that with the
// same overlap per radius forces grow by L^2, masses and energies by L^3, and times by L (Bierwisch et al. 2009; Feng and Owen 2014).
#pragma once

#include "law/sub_models.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns the power of L of the k-th number of `given`, one of `sub_models`; kNoPower: nothing is known of it.
Real power_of_number(const std::vector<GivenSubModel> &sub_models, const GivenSubModel &given,
                     std::size_t k);

// Returns the sub-models with the numbers of grains that are `scale` times as large as those that the numbers are of. Throws
// InputError where nothing is known of a number; with a `scale` of 1 none is looked at.
std::vector<GivenSubModel> coarse_grained(const std::vector<GivenSubModel> &sub_models, Real scale);

// Returns which numbers that changes, and to what, as "kn 1000 becomes 2000, rolling sds k 30 becomes 60"; empty: none.
std::string coarse_grain_text(const std::vector<GivenSubModel> &sub_models, Real scale);

// Whose numbers become what: "types 1 2", and coarse_grain_text().
struct CoarseGrained {
  std::string of, text;
};
// Returns a line for the log: what was applied, and each of these texts once, with the first that it is of where they differ.
std::string coarse_grain_line(Real scale, const std::vector<CoarseGrained> &laws);

}    // namespace lsdcd
