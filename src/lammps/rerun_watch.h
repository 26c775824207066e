// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Tells the command rerun from a run.
#ifndef LMP_RERUN_WATCH_H
#define LMP_RERUN_WATCH_H

#include "lmptype.h"

namespace LAMMPS_NS {

// LAMMPS does not say whether it reruns. Rerun initialises all and then the fixes once more before its first snapshot, and sets each
// snapshot up at its own step; a run is set up once, at its first step. Behind a part of 'run N every M' commands may initialise fixes, at
// its last step.
class RerunWatch {
 public:
  void init(const class Update &);       // in the fix's init()
  void end_run(const class Update &);    // in its post_run(), where may_be_snapshot() is asked
  // Returns, after init(), whether this may be a snapshot of a rerun. The atoms of a snapshot may be anywhere, and have the IDs of its
  // dump.
  bool may_be_snapshot(const class Update &) const;
  // Returns, in the fix's setup() or setup_pre_exchange(), whether this is a snapshot of a rerun.
  bool sees_snapshot(const class Update &);

 private:
  bigint first = -1, last = -1;                // steps of the run that was initialised
  int inits = 0;                               // of it, without a setup since
  bigint ended_first = -1, ended_last = -1;    // of the run, or its part, that has ended
};

}    // namespace LAMMPS_NS

#endif
