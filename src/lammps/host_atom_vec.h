// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// How LAMMPS makes an atom, and copies one over another, by which it deletes one.
#pragma once

#include "atom.h"
#if __has_include("atom_vec.h")
#include "atom_vec.h"
#else
// Packages of LAMMPS do not install atom_vec.h. These functions have had these names since 2008, no
// class but those of Kokkos 2021 has its own, and no data of the class is touched.
namespace LAMMPS_NS {
class AtomVec {
 public:
  void copy(int, int, int);
  void create_atom(int, double *);
};
}    // namespace LAMMPS_NS
#endif
