// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/host_box.h"

#include "base/input_words.h"

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
  return box;
}

std::string extents_text(const Box &box)
{
  std::string text;
  for (int k = 0; k < 3; k++)
    text += std::string(k ? ", " : "") + "xyz"[k] + " from " + number_text(box.lo[k]) + " to " +
            number_text(box.hi[k]);
  return text;
}

std::string outside_box(const Box &mesh, const LAMMPS_NS::Domain &domain, Real near)
{
  const PeriodicBox box = host_box(domain);
  // What is past a periodic face acts in the box by its image.
  Vec3 past = {near, near, near};
  for (int k = 0; k < 3; k++)
    if (box.periodic[k]) past[k] += box.width(k);
  const Box bounds = box.bounds(past);
  for (int k = 0; k < 3; k++) {
    // A shrink-wrapped face follows the atoms, wherever the mesh is.
    const bool lo_stays = domain.boundary[k][0] < 2, hi_stays = domain.boundary[k][1] < 2;
    if ((mesh.hi[k] < bounds.lo[k] && lo_stays) || (mesh.lo[k] > bounds.hi[k] && hi_stays))
      return "the mesh is outside the box: it spans " + extents_text(mesh) + ", the box " +
             extents_text(box.bounds({0, 0, 0})) +
             "; check the units of the file (scale) and the position (move)";
  }
  return "";
}

bool atoms_stay_close(const LAMMPS_NS::Neighbor &neighbor)
{
  return neighbor.dist_check && neighbor.every == 1 && neighbor.delay == 0 &&
         !neighbor.build_once && !neighbor.includegroup;
}

}    // namespace lsdcd
