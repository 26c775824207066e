// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/other_fixes.h"

#include "base/input_error.h"
#include "lammps/fix_insert_lsdcd.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_fixes.h"

#include "atom.h"
#include "modify.h"

#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
using lsdcd::RunFile;

namespace {

// A cache leaves alone what is no cache.
void check_apart(const RunFile &file, const RunFile &other, const std::string &of, bigint step)
{
  if (!file.written || (file.what == "cache" && !other.written) ||
      !lsdcd::are_one_file(file, other, step))
    return;
  throw lsdcd::InputError("in '" + file.what + "', '" + file.name + "' is " +
                          (file.name == other.name ? "" : "'" + other.name + "', ") + "the " +
                          (other.what == "file" ? "" : other.what + " ") + "file that " + of +
                          (other.written ? " writes" : " reads") + ": name another file");
}

std::vector<RunFile> files_of_fix(const Fix *fix)
{
  if (const auto *wall = dynamic_cast<const FixWallLsdcd *>(fix)) return wall->files();
  if (const auto *flow = dynamic_cast<const FixMassflowLsdcd *>(fix)) return flow->files();
  if (const auto *inlet = dynamic_cast<const FixInsertLsdcd *>(fix))
    if (!inlet->mesh_file().empty()) return {{"mesh", inlet->mesh_file()}};
  return {};
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
void LAMMPS_NS::check_files_apart(const Fix &of, Modify &modify, lsdcd::Host &host, bigint step)
{
  lsdcd::run_collectively(host, host.is_first(), [&] {
    const std::vector<RunFile> mine = files_of_fix(&of);
    for (std::size_t i = 0; i < mine.size(); i++)
      for (std::size_t k = 0; k < mine.size(); k++)
        if (i != k) check_apart(mine[i], mine[k], "this fix", step);
    for (const Fix *fix : lsdcd::host_fixes(modify)) {
      if (fix == &of) continue;
      for (const RunFile &file : mine)
        for (const RunFile &other : files_of_fix(fix))
          check_apart(file, other, "fix " + std::string(fix->id), step);
    }
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
