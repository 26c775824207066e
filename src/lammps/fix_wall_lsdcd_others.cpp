// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What must not be shared with another fix of the deck.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"
#include "lammps/fix_massflow_lsdcd.h"

#include "atom.h"
#include "comm.h"
#include "modify.h"
#include "update.h"

#include <vector>

using namespace LAMMPS_NS;

std::vector<lsdcd::DeckFile> FixWallLsdcd::files() const
{
  std::vector<lsdcd::DeckFile> all = lsdcd::files_of(settings);
  if (!material_file.empty()) all.push_back({"material", material_file});
  return all;
}

// A file that is written must be no other that a fix reads or writes: it would be lost without a
// word. A cache leaves alone what is no cache. The first process looks, as it writes them.
void FixWallLsdcd::check_files_apart() const
{
  const std::vector<lsdcd::DeckFile> mine = files();
  const auto check = [&](const lsdcd::DeckFile &file, const lsdcd::DeckFile &other,
                         const std::string &of) {
    if (!file.written || (file.what == "cache" && !other.written) ||
        !lsdcd::are_one_file(file, other, update->ntimestep))
      return;
    throw lsdcd::InputError("in '" + file.what + "', '" + file.name + "' is " +
                            (file.name == other.name ? "" : "'" + other.name + "', ") + "the " +
                            other.what + " file that " + of +
                            (other.written ? " writes" : " reads") + ": name another file");
  };
  const auto look = [&] {
    for (std::size_t i = 0; i < mine.size(); i++)
      for (std::size_t k = 0; k < mine.size(); k++)
        if (i != k) check(mine[i], mine[k], "this fix");
    for (int i = 0; i < modify->nfix; i++) {
      const Fix *const fix = modify->fix[i];
      const auto *wall = dynamic_cast<const FixWallLsdcd *>(fix);
      const auto *flow = dynamic_cast<const FixMassflowLsdcd *>(fix);
      std::vector<lsdcd::DeckFile> others;
      if (wall && wall != this) others = wall->files();
      if (flow) others = {{"mesh", flow->mesh_file()}};
      for (const lsdcd::DeckFile &file : mine)
        for (const lsdcd::DeckFile &other : others)
          check(file, other, "fix " + std::string(fix->id));
    }
  };
  try {
    lsdcd::run_collectively(world, comm->me == 0, look);
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
}

// Now, or as they may come in a group that has none yet. Collective.
bool FixWallLsdcd::shares_atoms_with(const Fix &other)
{
  if (igroup == other.igroup || igroup == 0 || other.igroup == 0) return true;
  need_on_host();
  int shares = 0;
  for (int i = 0; i < atom->nlocal; i++)
    shares |= (atom->mask[i] & groupbit) && (atom->mask[i] & other.groupbit);
  MPI_Allreduce(MPI_IN_PLACE, &shares, 1, MPI_INT, MPI_MAX, world);
  return shares != 0;
}

// The later of two fixes tells that both have the same mesh, which one fix refuses. Collective.
void FixWallLsdcd::check_doubled()
{
  for (int i = 0; i < modify->nfix && modify->fix[i] != this && !doubled_warned; i++) {
    const auto *other = dynamic_cast<const FixWallLsdcd *>(modify->fix[i]);
    if (!other) continue;
    for (const MeshPart &m : parts) {
      bool same = false;
      for (const MeshPart &of_other : other->meshes())
        same |= lsdcd::are_one_mesh(m.settings, of_other.settings);
      if (!same || !shares_atoms_with(*other)) continue;
      doubled_warned = true;
      warn("mesh '" + m.settings.file + "' is at the same place in fix " + other->id +
           ", whose group shares atoms with this one's: they feel every contact twice; leave one "
           "out, or move it");
      break;
    }
  }
}
