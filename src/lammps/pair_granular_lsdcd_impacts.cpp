// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Impacts between the grains of pair_style granular/lsdcd, for compute lsdcd/impacts.

#include "lammps/pair_granular_lsdcd.h"

#include "lammps/compute_impacts_lsdcd.h"
#include "lammps/fix_springs_lsdcd.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "law/energy_share.h"
#include "output/file_series.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "modify.h"
#include "update.h"

using namespace LAMMPS_NS;

void PairGranularLsdcd::find_impacts()
{
  impacts_asked = {};
  told_of_spectrum = false;
  for (const Compute *compute : lsdcd::host_computes(*modify))
    if (const auto *found = dynamic_cast<const ComputeImpactsLsdcd *>(compute))
      impacts_asked = found->asked();
}

double PairGranularLsdcd::share_of(int i, int j) const
{
  if (!given.count({i, i}) || !given.count({j, j})) return 0.5;
  return lsdcd::energy_share(numbers[law_index(i, i)], numbers[law_index(j, j)]);
}

std::vector<lsdcd::TypesSpectrum> PairGranularLsdcd::impacts() const
{
  lsdcd::MpiHost host(world);
  std::vector<lsdcd::TypesSpectrum> all;
  if (!springs) return all;
  const lsdcd::PairSpectra sum = springs->impacts.summed(host, n_types);
  for (const auto &[types, spectrum] : sum.all())
    all.push_back({types.first, types.second, share_of(types.first, types.second), spectrum});
  return all;
}

void PairGranularLsdcd::record_impacts(const lsdcd::PairJob &step)
{
  springs->add_impacts(step);
  const lsdcd::FileEvery &file = impacts_asked.spectrum;
  if (file.every == 0 || update->ntimestep % file.every != 0) return;
  const std::vector<lsdcd::TypesSpectrum> all = impacts();
  lsdcd::MpiHost host(world);
  try {
    lsdcd::run_collectively(host, comm->me == 0, [&] {
      lsdcd::write_spectra(lsdcd::file_of_step(file.name, update->ntimestep), all);
    });
  } catch (const lsdcd::InputError &e) {
    if (!told_of_spectrum)
      warn(
          std::string(e.what()) +
          ": there is no impact_spectrum of this step; older files are unchanged. Free disk space, "
          "or correct the path: the run goes on and tries again with the next file");
    told_of_spectrum = true;
  }
}
