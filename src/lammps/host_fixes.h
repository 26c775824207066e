// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Which fixes, computes and regions there are. LAMMPS 13Nov2026 has no lists of Modify (nfix, fix, find_fix and those of computes), and LAMMPS
// before 14Dec2021 has nothing else.
#ifndef LSDCD_HOST_FIXES_H
#define LSDCD_HOST_FIXES_H

#include "compute.h"
#include "domain.h"
#include "fix.h"
#include "modify.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns all fixes in the order in which LAMMPS calls them. While LAMMPS replaces one, its place is null.
inline std::vector<LAMMPS_NS::Fix *> host_fixes(LAMMPS_NS::Modify &modify)
{
#if LSDCD_HOST_VERSION < 20220601
  std::vector<LAMMPS_NS::Fix *> fixes;
  for (int i = 0; i < modify.nfix; i++) fixes.push_back(modify.fix[i]);
  return fixes;
#else
  return modify.get_fix_list();
#endif
}

// Returns all computes in their order.
inline std::vector<LAMMPS_NS::Compute *> host_computes(LAMMPS_NS::Modify &modify)
{
#if LSDCD_HOST_VERSION < 20220601
  std::vector<LAMMPS_NS::Compute *> computes;
  for (int i = 0; i < modify.ncompute; i++) computes.push_back(modify.compute[i]);
  return computes;
#else
  return modify.get_compute_list();
#endif
}

// Returns the fix of this ID; null if there is none.
inline LAMMPS_NS::Fix *host_fix(LAMMPS_NS::Modify &modify, const std::string &id)
{
  for (LAMMPS_NS::Fix *fix : host_fixes(modify))
    if (fix && id == fix->id) return fix;
  return nullptr;
}

// Returns the compute of this ID; null if there is none.
inline LAMMPS_NS::Compute *host_compute(LAMMPS_NS::Modify &modify, const std::string &id)
{
  for (LAMMPS_NS::Compute *compute : host_computes(modify))
    if (id == compute->id) return compute;
  return nullptr;
}

// Returns all regions in their order.
inline std::vector<LAMMPS_NS::Region *> host_regions(LAMMPS_NS::Domain &domain)
{
#if LSDCD_HOST_VERSION < 20220601
  return std::vector<LAMMPS_NS::Region *>(domain.regions, domain.regions + domain.nregion);
#else
  return domain.get_region_list();
#endif
}

}    // namespace lsdcd

#endif
