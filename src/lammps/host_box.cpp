// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/host_box.h"

#include "domain.h"
#include "neighbor.h"

namespace lsdcd {

PeriodicBox host_box(const LAMMPS_NS::Domain &domain)
{
  const double *lo = domain.boxlo, *size = domain.prd;
  PeriodicBox box;
  box.corner = {lo[0], lo[1], lo[2]};
  box.edge[0] = {size[0], 0, 0};
  box.edge[1] = {domain.triclinic ? domain.xy : 0, size[1], 0};
  box.edge[2] = {domain.triclinic ? domain.xz : 0, domain.triclinic ? domain.yz : 0, size[2]};
  // In two dimensions all is at z = 0, and periodicity along z means nothing.
  for (int k = 0; k < 3; k++)
    box.periodic[k] = domain.periodicity[k] && !(domain.dimension == 2 && k == 2);
  for (int k = 0; k < 3; k++)
    for (int face = 0; face < 2; face++) box.face_follows[k][face] = domain.boundary[k][face] >= 2;
  box.dimension = domain.dimension;
  return box;
}

namespace {

// Does LAMMPS reneighbour by how far atoms have gone, all of them?
bool looks_at_atoms(const LAMMPS_NS::Neighbor &neighbor)
{
  return neighbor.dist_check && !neighbor.build_once && !neighbor.includegroup;
}

}    // namespace

bool atoms_stay_close(const LAMMPS_NS::Neighbor &neighbor)
{
  return neighbor.every == 1 && neighbor.delay == 0 && looks_at_atoms(neighbor);
}

bool has_looked_at_atoms(const LAMMPS_NS::Neighbor &neighbor)
{
  return neighbor.ago > 0 && neighbor.ago >= neighbor.delay && neighbor.ago % neighbor.every == 0 &&
         looks_at_atoms(neighbor);
}

}    // namespace lsdcd
