// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// compute lsdcd/impacts: how often grains of pair_style granular/lsdcd hit each other, and how hard. The pair style finds the impacts.
#ifndef LMP_COMPUTE_IMPACTS_LSDCD_H
#define LMP_COMPUTE_IMPACTS_LSDCD_H

#include "compute.h"

#include "input/impacts_settings.h"
#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "lammps/rerun_watch.h"
#include "output/impact_spectrum.h"
#include "wall/spec/run_files.h"

#include <vector>

namespace LAMMPS_NS {

class ComputeImpactsLsdcd : public Compute, protected OwnMessages {
 public:
  ComputeImpactsLsdcd(class LAMMPS *, int, char **);
  ~ComputeImpactsLsdcd() override;

  void init() override;
  void setup() override;
  void compute_vector() override;
  void compute_array() override;

  const lsdcd::ImpactsSettings &asked() const { return settings; }
  std::vector<lsdcd::RunFile> files() const;    // that the pair style writes for it

 private:
  // Returns the spectra of all pairs of types that have impacts, over all processes. Collective.
  std::vector<lsdcd::TypesSpectrum> spectra() const;

  lsdcd::ImpactsSettings settings;
  OutputVariables variables;
  bool told_of_rerun = false;    // in which nothing is recorded
  RerunWatch watch;
};

}    // namespace LAMMPS_NS

#endif
