// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/compute_impacts_lsdcd.h"

#include "base/atomic_file.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/pair_granular_lsdcd.h"
#include "output/file_series.h"

#include "atom.h"
#include "comm.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using lsdcd::TypesSpectrum;

ComputeImpactsLsdcd::ComputeImpactsLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), OwnMessages(lmp, "Compute", id, "lsdcd/impacts"),
    variables(lmp, std::string("c_") + id)
{
  if (igroup != 0) fatal("pairs are of all atoms: compute ID all lsdcd/impacts");
  std::vector<std::string> names;
  run_core([&] {
    std::vector<std::string> words = words_of(arg + 3, arg + narg);
    const auto begins = std::find(words.begin(), words.end(), "names");
    names.assign(begins, words.end());
    words.erase(begins, words.end());
    settings = lsdcd::parse_impacts(words);
  });

  vector_flag = array_flag = 1;
  extvector = extarray = 1;
  size_vector = lsdcd::n_elements(lsdcd::impact_outputs());
  size_array_rows = atom->ntypes * (atom->ntypes + 1) / 2;
  size_array_cols = lsdcd::n_elements(lsdcd::impact_outputs_by_types());
  vector = new double[size_vector];
  memory->create(array, size_array_rows, size_array_cols, "lsdcd/impacts:array");
  run_core([&] {
    if (!names.empty())
      variables.make(names, lsdcd::named_elements(lsdcd::impact_outputs(), false));
  });
}

ComputeImpactsLsdcd::~ComputeImpactsLsdcd()
{
  delete[] vector;
  memory->destroy(array);
}

std::vector<lsdcd::RunFile> ComputeImpactsLsdcd::files() const
{
  if (settings.spectrum.every == 0) return {};
  return {{"impact_spectrum", settings.spectrum.name, settings.spectrum.every, true}};
}

// The pair style, whose init comes first, has found this compute.
void ComputeImpactsLsdcd::init()
{
  watch.init(*update);
  if (!dynamic_cast<const PairGranularLsdcd *>(force->pair))
    fatal("it records impacts between grains of pair_style granular/lsdcd, which is missing or "
          "within a hybrid style: for walls use the keyword impacts of fix wall/lsdcd");
  if (std::strncmp(update->integrate_style, "respa", 5) == 0)
    fatal("an impact is found by the way of one timestep: use run_style verlet");
  const std::vector<Compute *> computes = lsdcd::host_computes(*modify);
  if (std::count_if(computes.begin(), computes.end(), [](const Compute *compute) {
        return dynamic_cast<const ComputeImpactsLsdcd *>(compute) != nullptr;
      }) > 1)
    fatal("there are two computes lsdcd/impacts: all impacts are recorded once, so that only one "
          "is allowed");
  if (settings.spectrum.every == 0) return;
  lsdcd::MpiHost host(world);
  try {
    lsdcd::run_collectively(host, comm->me == 0, [&] {
      lsdcd::AtomicFile(lsdcd::file_of_step(settings.spectrum.name, update->ntimestep));
    });
  } catch (const lsdcd::InputError &e) {
    fatal(std::string("in 'impact_spectrum', ") + e.what() + "; make the folder, or name another");
  }
}

void ComputeImpactsLsdcd::setup()
{
  if (!watch.sees_snapshot(*update) || told_of_rerun) return;
  warn("a rerun has no steps, and records no impacts");
  told_of_rerun = true;
}

std::vector<TypesSpectrum> ComputeImpactsLsdcd::spectra() const
{
  return static_cast<const PairGranularLsdcd *>(force->pair)->impacts();
}

void ComputeImpactsLsdcd::compute_vector()
{
  invoked_vector = update->ntimestep;
  std::fill_n(vector, size_vector, 0.0);
  for (const TypesSpectrum &of : spectra()) {
    vector[0] += of.spectrum.impacts();
    vector[1] += of.spectrum.energy();
  }
}

void ComputeImpactsLsdcd::compute_array()
{
  invoked_array = update->ntimestep;
  const std::vector<TypesSpectrum> all = spectra();
  auto next = all.begin();
  double **row = array;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      double *to = *row++;
      std::fill_n(to, size_array_cols, 0.0);
      to[0] = i;
      to[1] = j;
      if (next == all.end() || next->type_i != i || next->type_j != j) continue;
      const double energy = next->spectrum.energy();
      to[2] = next->spectrum.impacts();
      to[3] = energy;
      to[4] = next->share_i * energy;
      to[5] = (1 - next->share_i) * energy;
      ++next;
    }
}
