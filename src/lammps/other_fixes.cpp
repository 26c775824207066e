// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/other_fixes.h"

#include "lammps/compute_collide_lsdcd.h"
#include "lammps/compute_impacts_lsdcd.h"
#include "lammps/fix_insert_lsdcd.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_fixes.h"
#include "lammps/pair_granular_lsdcd.h"
#include "lammps/region_mesh_lsdcd.h"

#include "atom.h"
#include "domain.h"
#include "force.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using lsdcd::RunFile;

namespace {

const char *const kPairStyle = "granular/lsdcd";

std::vector<RunFile> files_of_fix(const Fix *fix)
{
  if (const auto *wall = dynamic_cast<const FixWallLsdcd *>(fix)) return wall->files();
  if (const auto *flow = dynamic_cast<const FixMassflowLsdcd *>(fix)) return flow->files();
  if (const auto *inlet = dynamic_cast<const FixInsertLsdcd *>(fix))
    if (!inlet->mesh_file().empty()) return {{"mesh", inlet->mesh_file()}};
  return {};
}

// Calls use(files, "compute 3") for each other one of our styles.
template <class Use>
void for_files_beside(const Fix &of, LAMMPS &lmp, const Use &use)
{
  for (const Fix *fix : lsdcd::host_fixes(*lmp.modify))
    if (fix != &of) use(files_of_fix(fix), "fix " + std::string(fix->id));
  for (const Compute *compute : lsdcd::host_computes(*lmp.modify)) {
    const std::string name = "compute " + std::string(compute->id);
    if (const auto *collide = dynamic_cast<const ComputeCollideLsdcd *>(compute))
      use(collide->files(), name);
    if (const auto *impacts = dynamic_cast<const ComputeImpactsLsdcd *>(compute))
      use(impacts->files(), name);
  }
  for (const Region *region : lsdcd::host_regions(*lmp.domain))
    if (const auto *mesh = dynamic_cast<const RegionMeshLsdcd *>(region))
      use({{"mesh", mesh->mesh_file()}}, "region " + std::string(region->id));
  // A hybrid style may have several; it returns its only one whichever is asked for.
  const Pair *last = nullptr;
  for (int k = 1; const Pair *pair = lmp.force->pair_match(kPairStyle, 0, k); k++) {
    if (pair == last) break;
    last = pair;
    if (const auto *granular = dynamic_cast<const PairGranularLsdcd *>(pair))
      use(granular->files(), std::string("pair_style ") + kPairStyle);
  }
}

// Now, or as they may come in a group that has none yet. Collective.
bool share_atoms(const Fix &a, const Fix &b, const Atom &atom, MPI_Comm world)
{
  if (a.igroup == b.igroup || a.igroup == 0 || b.igroup == 0) return true;
  int shares = 0;
  for (int i = 0; i < atom.nlocal; i++)
    shares |= (atom.mask[i] & a.groupbit) && (atom.mask[i] & b.groupbit);
  MPI_Allreduce(MPI_IN_PLACE, &shares, 1, MPI_INT, MPI_MAX, world);
  return shares != 0;
}

}    // namespace

// The first process looks, as it writes them.
void LAMMPS_NS::check_files_apart(const Fix &of, LAMMPS &lmp, lsdcd::Host &host)
{
  const bigint step = lmp.update->ntimestep;
  lsdcd::run_collectively(host, host.is_first(), [&] {
    const std::vector<RunFile> mine = files_of_fix(&of);
    check_apart(mine, "this fix", step);
    for_files_beside(of, lmp, [&](const std::vector<RunFile> &others, const std::string &owner) {
      for (const RunFile &file : mine)
        for (const RunFile &other : others) check_apart(file, other, owner, step);
    });
  });
}

std::string LAMMPS_NS::doubled_mesh(const FixWallLsdcd &wall, Modify &modify, const Atom &atom,
                                    MPI_Comm world)
{
  for (const Fix *fix : lsdcd::host_fixes(modify)) {
    if (fix == &wall) break;
    const auto *other = dynamic_cast<const FixWallLsdcd *>(fix);
    if (!other) continue;
    for (const lsdcd::MeshPart &m : wall.meshes()) {
      bool same = false;
      for (const lsdcd::MeshPart &of_other : other->meshes())
        same |= lsdcd::are_one_mesh(wall.spec(), m.spec, other->spec(), of_other.spec);
      if (same && share_atoms(wall, *other, atom, world))
        return "mesh '" + m.spec.name + "' is at the same place in fix " + other->id +
               ", whose group shares atoms with this one's: they feel every contact twice; leave "
               "one out, or move it";
    }
  }
  return "";
}

std::vector<int> LAMMPS_NS::steps_between_changes(Modify &modify)
{
  std::vector<int> found;
  for (Fix *fix : lsdcd::host_fixes(modify))
    for (const char *style : {"set", "bond/react", "python/invoke"})
      if (std::strcmp(fix->style, style) == 0) found.push_back(std::max(1, fix->nevery));
  return found;
}

bool LAMMPS_NS::atoms_may_have_changed(const std::vector<int> &steps_between, bigint step)
{
  return std::any_of(steps_between.begin(), steps_between.end(),
                     [step](int every) { return step % every == 0 || step % every == 1; });
}

std::string LAMMPS_NS::late_pair_springs(const Fix &fix, Modify &modify)
{
  bool is_behind = false;
  for (const Fix *other : lsdcd::host_fixes(modify)) {
    is_behind = is_behind || other == &fix;
    if (is_behind && std::strncmp(other->style, "NEIGH_HISTORY", 13) == 0)
      return "this fix creates or deletes atoms before the pair style gives springs to theirs, and "
             "they would go to others: "
             "write pair_style before this fix";
  }
  return "";
}

std::string LAMMPS_NS::doubtful_bodies(Modify &modify, const char *pair_style)
{
  const auto ends_in_kk = [](const std::string &style) {
    return style.size() > 3 && style.compare(style.size() - 3, 3, "/kk") == 0;
  };
  for (const Fix *fix : lsdcd::host_fixes(modify)) {
    if (!fix->rigid_flag) continue;
    const std::string pairs = pair_style ? pair_style : "", name = std::string("fix ") + fix->id;
    if (pairs.compare(0, 5, "gran/") == 0 && ends_in_kk(pairs))
      return "pair_style " + pairs + " damps spheres of the bodies of " + name +
             " by the masses of the spheres, where the wall takes those of the bodies: use "
             "granular/lsdcd/kk, or the style without /kk";
    if (ends_in_kk(fix->style))
      return name + " of style " + fix->style +
             " has not been tried with walls: compare a short run with one of the style without "
             "/kk";
  }
  return "";
}
