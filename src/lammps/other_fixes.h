// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Things that a fix must not share with others of the script, and the order of fixes.
#ifndef LMP_OTHER_FIXES_H
#define LMP_OTHER_FIXES_H

#include "lmptype.h"

#include <mpi.h>
#include <string>
#include <vector>

namespace lsdcd {
class Host;
}

namespace LAMMPS_NS {

// Throws InputError on all processes if a file that the fix writes is one that another of our styles reads or writes: it would be lost
// without a word. Collective.
void check_files_apart(const class Fix &, class LAMMPS &, lsdcd::Host &);

// Returns a text if an earlier fix has a mesh of this fix, at the same place and for some of its atoms; empty: none has. The later fix
// warns. Collective.
std::string doubled_mesh(const class FixWallLsdcd &, class Modify &, const class Atom &, MPI_Comm);

// Returns every how many steps fixes act that may change types, radii or masses of atoms in a run, also between lists. Fix adapt is not
// among them: it also changes ghost atoms, and in the step itself.
std::vector<int> steps_between_changes(class Modify &);
// Returns whether fixes that act every so many steps may have changed atoms since the last step: at its end, as fix set does, or in
// this one.
bool atoms_may_have_changed(const std::vector<int> &steps_between, bigint step);

// Returns a text if a pair style of LAMMPS puts the springs of pairs to their atoms after this fix has created or deleted some, so that
// they would go to other atoms; empty: none does.
std::string late_pair_springs(const class Fix &, class Modify &);

// Returns a text if what moves rigid bodies, or the pair style, may not be as walls have it: a rigid fix of Kokkos, which has not been
// tried, or LAMMPS's own pairs of grains for Kokkos, which damp clumps by the masses of their spheres. Empty: all is.
std::string doubtful_bodies(class Modify &, const char *pair_style);

}    // namespace LAMMPS_NS

#endif
