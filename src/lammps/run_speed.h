// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// What the first of our fixes in a script says at the end of a run of its own speed; see lammps/run_advice.h.
#ifndef LSDCD_RUN_SPEED_H
#define LSDCD_RUN_SPEED_H

#include "lmptype.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
}    // namespace LAMMPS_NS

namespace lsdcd {

class RunSpeed {
 public:
  explicit RunSpeed(LAMMPS_NS::LAMMPS *lmp) : lmp_(lmp) {}

  void begin_run() { forced_ = 0; }
  // Looks, as lists are made anew, whether some fix has asked for it, and when the next one will.
  void see_new_list();
  // Returns what is not said yet, if `fix` is the first of ours: a wall, or else the springs of the pair style. Collective.
  std::vector<std::string> end_run(const LAMMPS_NS::Fix *fix);

 private:
  LAMMPS_NS::LAMMPS *lmp_;
  LAMMPS_NS::bigint forced_ = 0, due_ = -1;
  bool wait_told_ = false, skin_told_ = false;
};

}    // namespace lsdcd

#endif
