// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Decides whether a variable of LAMMPS reads atoms. LAMMPS evaluates variables on the CPU, where atoms may be older than on a GPU.
#ifndef LSDCD_VARIABLE_FORMULA_H
#define LSDCD_VARIABLE_FORMULA_H

#include <functional>
#include <string>

namespace lsdcd {

// Returns whether a formula of style equal may read atoms: true if it has a name that is not known to depend on the run alone, as
// its time or the bounds of its box do. Outputs of fixes are on the CPU. `variable_does`, `compute_does`: whether v_NAME or c_ID
// reads atoms.
bool formula_reads_atoms(const std::string &formula,
                         const std::function<bool(const std::string &)> &variable_does,
                         const std::function<bool(const std::string &)> &compute_does);

}    // namespace lsdcd

#endif
