// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Decides whether a variable of this LAMMPS reads atoms: see variable_formula.h.
#ifndef LSDCD_VARIABLE_READS_H
#define LSDCD_VARIABLE_READS_H

#include "host_kokkos.h"
#include "variable_formula.h"

#include "compute.h"
#include "info.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "variable.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns whether a variable may read atoms. True for variables of styles other than equal, and for those that refer to each other without
// end.
inline bool variable_reads_atoms(LAMMPS_NS::LAMMPS *lmp, const std::string &name, int depth = 0)
{
  constexpr int kDeepest = 100;
  const int variable = lmp->input->variable->find(name.c_str());
  if (variable < 0 || depth > kDeepest) return true;
  const std::string info = LAMMPS_NS::Info(lmp).get_variable_info(variable), begin = "def =";
  if (info.find("style = equal,") == std::string::npos) return true;
  return formula_reads_atoms(
      info.substr(info.find(begin) + begin.size()),
      [&](const std::string &other) { return variable_reads_atoms(lmp, other, depth + 1); },
      [&](const std::string &id) {
        const LAMMPS_NS::Compute *const compute = lmp->modify->get_compute_by_id(id);
        return !compute || !compute->kokkosable;
      });
}

// Copies all atoms to LAMMPS's own arrays before variables that may read them are evaluated there, as LAMMPS's own fixes for Kokkos do for
// all variables. A fix with /kk/host needs it, too, because others change atoms on the device.
class VariableAtoms {
 public:
  // Checks the variables again from now on. Called at the end of a run, because commands after it may change variables.
  void look_again() { is_known_ = false; }
  // Copies all atoms to the host, if needed, before the variables with these names are evaluated. Calls tell(name) for each variable that
  // may read atoms.
  template <class Tell>
  void bring(LAMMPS_NS::LAMMPS *lmp, const std::vector<std::string> &names, const Tell &tell)
  {
    if (kSharesAtoms) return;
    if (!is_known_) {
      reads_ = false;
      for (const std::string &name : names) {
        if (!variable_reads_atoms(lmp, name)) continue;
        reads_ = true;
        tell(name);
      }
      is_known_ = true;
    }
    if (reads_) static_cast<LAMMPS_NS::AtomKokkos *>(lmp->atom)->sync(LAMMPS_NS::Host, ALL_MASK);
  }

 private:
  bool is_known_ = false, reads_ = false;
};

}    // namespace lsdcd

#endif
