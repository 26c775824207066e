// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// A snapshot of the command rerun: forces of one step, with no steps before it.

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"

#include "atom.h"
#include "update.h"

using namespace LAMMPS_NS;

// What follows from the time alone is right in a snapshot; what is added up from step to step is
// not known there.
void FixWallLsdcd::begin_snapshot()
{
  try {
    for (const MeshPart &m : parts) m.motion.check_snapshot(step_now());
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
  for (int i = 0; history->is_kept() && i < atom->nlocal; i++) springs_on_host().clear(i);
  if (rerun_told) return;
  rerun_told = true;
  if (history->is_kept())
    warn("a rerun does not know the springs of contacts, which no dump has: friction, rolling, "
         "twisting and adhesion past touch begin at 0 in each snapshot");
  if (settings.has_loads())
    warn("a rerun has no steps over which loads and wear add up: no wear is counted and no "
         "mesh_fields are written");
}
