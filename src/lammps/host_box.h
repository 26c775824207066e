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

// Does LAMMPS reneighbour before any atom has gone farther than half the skin? A step in which one
// has is a reneighbouring.
bool atoms_stay_close(const LAMMPS_NS::Neighbor &neighbor);

// Has LAMMPS looked at all atoms in this step, which was no reneighbouring? Then none has gone farther than half the skin
// since the last one. With a delay it looks in the steps after it.
bool has_looked_at_atoms(const LAMMPS_NS::Neighbor &neighbor);

}    // namespace lsdcd

#endif
