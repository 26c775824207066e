// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Whether a variable of LAMMPS reads atoms, which a GPU has newer than the CPU on which LAMMPS evaluates it.
#ifndef LSDCD_VARIABLE_FORMULA_H
#define LSDCD_VARIABLE_FORMULA_H

#include <functional>
#include <string>

namespace lsdcd {

// Returns whether a formula of style equal may read atoms: a name that is not known to be of the run alone, as its time and the
// bounds of its box, may. Outputs of fixes are on the CPU. `variable_does`, `compute_does`: whether what v_NAME and c_ID mean does.
bool formula_reads_atoms(const std::string &formula,
                         const std::function<bool(const std::string &)> &variable_does,
                         const std::function<bool(const std::string &)> &compute_does);

}    // namespace lsdcd

#endif
