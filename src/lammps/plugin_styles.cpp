// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/plugin_styles.h"

#include "lammps/compute_collide_lsdcd.h"
#include "lammps/compute_energy_lsdcd.h"
#include "lammps/compute_impacts_lsdcd.h"
#include "lammps/fix_insert_lsdcd.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_springs_lsdcd.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/pair_granular_lsdcd.h"
#include "lammps/region_mesh_lsdcd.h"

#include "lammps.h"
#include "modify.h"

namespace lsdcd {

namespace {

// All but its creator.
lammpsplugin_t described(const char *kind, void *lmp, void *handle, const char *name,
                         const char *info)
{
  lammpsplugin_t plugin{};
  plugin.version = static_cast<LAMMPS_NS::LAMMPS *>(lmp)->version;
  plugin.style = kind;
  plugin.name = name;
  plugin.info = info;
  plugin.author = "the LSDCD authors";
  plugin.handle = handle;
  return plugin;
}

// LAMMPS's own: Debian has no header of it.
void *create_gravity(void *lmp, int narg, char **arg)
{
  auto *const host = static_cast<LAMMPS_NS::LAMMPS *>(lmp);
  return (*host->modify->fix_map)["gravity"](host, narg, arg);
}

}    // namespace

void add_style(const char *kind, void *lmp, void *handle, void *regfunc, const char *name,
               const char *info, lammpsplugin_factory2 *create)
{
  lammpsplugin_t plugin = described(kind, lmp, handle, name, info);
  plugin.creator.v2 = create;
  reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
}

void add_pair_style(void *lmp, void *handle, void *regfunc, const char *name, const char *info,
                    lammpsplugin_factory1 *create)
{
  lammpsplugin_t plugin = described("pair", lmp, handle, name, info);
  plugin.creator.v1 = create;
  reinterpret_cast<lammpsplugin_regfunc>(regfunc)(&plugin, lmp);
}

void add_plain_styles(void *lmp, void *handle, void *regfunc)
{
  using namespace LAMMPS_NS;
  add_style("fix", lmp, handle, regfunc, "wall/lsdcd", "fix wall/lsdcd: DEM walls from an STL mesh",
            create_fix<GuardedFix<FixWallLsdcd>>);
  add_style("fix", lmp, handle, regfunc, "massflow/lsdcd",
            "fix massflow/lsdcd: what passes a surface from an STL mesh",
            create_fix<GuardedFix<FixMassflowLsdcd>>);
  add_style("fix", lmp, handle, regfunc, "insert/lsdcd",
            "fix insert/lsdcd: grains through a flat mesh or into a region",
            create_fix<GuardedFix<FixInsertLsdcd>>);
  add_style("fix", lmp, handle, regfunc, "gravity/lsdcd",
            "fix gravity/lsdcd: fix gravity under the name of its form for Kokkos", create_gravity);
  add_style("fix", lmp, handle, regfunc, "SPRINGS/LSDCD",
            "fix SPRINGS/LSDCD: what pairs of granular/lsdcd keep",
            create_fix<GuardedFix<FixSpringsLsdcd>>);
  add_pair_style(lmp, handle, regfunc, "granular/lsdcd",
                 "pair_style granular/lsdcd: contact laws of the wall between grains",
                 create_pair<GuardedPair<PairGranularLsdcd>>);
  add_style("compute", lmp, handle, regfunc, "lsdcd/collide",
            "compute lsdcd/collide: rigid bodies against the walls of fix wall/lsdcd",
            create_style<Compute, GuardedCompute<ComputeCollideLsdcd>>);
  add_style("compute", lmp, handle, regfunc, "lsdcd/energy",
            "compute lsdcd/energy: what contacts of pair_style granular/lsdcd dissipate",
            create_style<Compute, GuardedCompute<ComputeEnergyLsdcd>>);
  add_style("compute", lmp, handle, regfunc, "lsdcd/impacts",
            "compute lsdcd/impacts: how hard grains of pair_style granular/lsdcd hit each other",
            create_style<Compute, GuardedCompute<ComputeImpactsLsdcd>>);
  add_style("region", lmp, handle, regfunc, "mesh/lsdcd",
            "region mesh/lsdcd: the inside of a closed mesh",
            create_style<Region, GuardedRegion<RegionMeshLsdcd>>);
}

}    // namespace lsdcd
