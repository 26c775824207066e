// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What our fixes ask of LAMMPS's box and neighbour lists.
#ifndef LSDCD_HOST_BOX_H
#define LSDCD_HOST_BOX_H

#include "mesh/periodic_box.h"

#include <string>

namespace LAMMPS_NS {
class Domain;
class Neighbor;
}    // namespace LAMMPS_NS

namespace lsdcd {

// The simulation box, without a margin.
PeriodicBox host_box(const LAMMPS_NS::Domain &domain);

std::string extents_text(const Box &box);    // "x from 0 to 1, y from 0 to 2, z from 0 to 1"

// Empty where something of the mesh is nearer than `near` to the box or, where faces are periodic,
// to one of its images; shrink-wrapped faces go wherever atoms go. Else what is wrong.
std::string outside_box(const Box &mesh, const LAMMPS_NS::Domain &domain, Real near);

// Does LAMMPS reneighbour before any atom has gone farther than half the skin? A step in which one
// has is a reneighbouring.
bool atoms_stay_close(const LAMMPS_NS::Neighbor &neighbor);

}    // namespace lsdcd

#endif
