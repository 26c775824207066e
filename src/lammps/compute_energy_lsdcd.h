// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// compute lsdcd/energy: what contacts between grains do with energy, and the balance of the whole with the walls.
#ifndef LMP_COMPUTE_ENERGY_LSDCD_H
#define LMP_COMPUTE_ENERGY_LSDCD_H

#include "compute.h"

#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "lammps/rerun_watch.h"

#include <vector>

namespace LAMMPS_NS {

class ComputeEnergyLsdcd : public Compute, protected OwnMessages {
 public:
  ComputeEnergyLsdcd(class LAMMPS *, int, char **);
  ~ComputeEnergyLsdcd() override;

  void init() override;
  void setup() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  const class PairGranularLsdcd &pair() const;
  std::vector<class FixWallLsdcd *> walls() const;
  void find_discs();
  double kinetic() const;
  double potential() const;

  OutputVariables variables;
  bool told = false;             // of a wall that records nothing
  bool told_of_rerun = false;    // in which nothing is recorded
  int discs = 0;                 // bits of the groups whose grains are discs
  RerunWatch watch;
};

}    // namespace LAMMPS_NS

#endif
