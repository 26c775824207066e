// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Runs of LAMMPS with the plugin: alone, by mpirun, and with Kokkos.
#pragma once

#include "tool/check_line.h"

#include <string>
#include <vector>

namespace lsdcd {

struct LammpsCheckOptions {
  std::string program, plugin;    // files; empty: looked for
  double seconds = 20;            // for each program; 0: none is started
};

// Returns the lines of LAMMPS, its plugin, MPI and Kokkos: a grain lies 0.1 % of its radius deep in a mesh, and LAMMPS prints the force.
// Throws InputError if a file that the options name is not there.
std::vector<CheckLine> check_lammps(const LammpsCheckOptions &options);

}    // namespace lsdcd
