// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// LAMMPS's box and neighbour lists, as our fixes need them.
#ifndef LSDCD_HOST_BOX_H
#define LSDCD_HOST_BOX_H

#include "box/periodic_box.h"

namespace LAMMPS_NS {
class Domain;
class Neighbor;
}    // namespace LAMMPS_NS

namespace lsdcd {

// Returns the simulation box, without a margin.
PeriodicBox host_box(const LAMMPS_NS::Domain &domain);

// Returns whether LAMMPS reneighbours in any step in which an atom has gone farther than half the skin.
bool atoms_stay_close(const LAMMPS_NS::Neighbor &neighbor);

// Returns whether LAMMPS has looked at all atoms in this step, which was no reneighbouring. Then none has gone farther than half the skin
// since the last reneighbouring. With a delay LAMMPS looks only in the steps after it.
bool has_looked_at_atoms(const LAMMPS_NS::Neighbor &neighbor);

}    // namespace lsdcd

#endif
