// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/rerun_watch.h"

#include "update.h"

using namespace LAMMPS_NS;

static constexpr int kDynamics = 1;

// Commands between runs, and between the parts of 'run N every M', initialise fixes and set up exchanges, too: outside of a run, or with
// the steps of the last one.
void RerunWatch::init(const Update &update)
{
  if (update.whichflag != kDynamics) return;
  if (update.firststep != first || update.laststep != last) inits = 0;
  first = update.firststep;
  last = update.laststep;
  inits++;
}

void RerunWatch::end_run(const Update &update)
{
  ended_first = update.firststep;
  ended_last = update.laststep;
}

// Behind a run, or a part of one, atoms have the places and IDs that it and commands have given them, not those of a dump.
bool RerunWatch::may_be_snapshot(const Update &update) const
{
  const bool behind_a_run = update.firststep == ended_first && update.laststep == ended_last &&
                            update.ntimestep == ended_last;
  return update.whichflag == kDynamics && !behind_a_run &&
         (inits > 1 || update.ntimestep != update.firststep);
}

bool RerunWatch::sees_snapshot(const Update &update)
{
  if (update.whichflag != kDynamics || update.setupflag == 0) return false;
  const bool twice = inits > 1;
  inits = 0;
  ended_first = ended_last = -1;    // a rerun may have the steps of the run before it
  return twice || update.ntimestep != update.firststep;
}
