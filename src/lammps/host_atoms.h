// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What LAMMPS's atoms are, and between which of them its pair style acts.
#ifndef LSDCD_HOST_ATOMS_H
#define LSDCD_HOST_ATOMS_H

#include <string>

// Whether LAMMPS has fix heat/flow and what it integrates: since this stable version.
#define HOST_HAS_HEAT (LSDCD_HOST_VERSION >= 20230802)

namespace LAMMPS_NS {
class Atom;
class Neighbor;
}    // namespace LAMMPS_NS

namespace lsdcd {

class Host;

// Returns the shapes that the atom style allows, as kEllipsoids if there are no others; empty: all atoms are spheres or points.
constexpr char kEllipsoids[] = "ellipsoids";
std::string shape_of_atoms(const LAMMPS_NS::Atom &atom);

// Returns whether there is an atom of one group and an atom of the other, by the bits of their groups, which no
// neigh_modify exclude keeps apart. Known once LAMMPS has set up its neighbour lists. Atoms of both groups are taken to
// be in different molecules. Collective.
bool pairs_act_between(const LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Atom &atom,
                       int group_bit, int other_bit, Host &host);

}    // namespace lsdcd

#endif
