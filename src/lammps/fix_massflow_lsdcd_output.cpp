// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Totals of fix massflow/lsdcd: over all processes, as output, and in restart files.

#include "lammps/fix_massflow_lsdcd.h"

#include "lammps/restart_data.h"

#include "comm.h"

#include <algorithm>

using namespace LAMMPS_NS;

static const char *const kKind = "mass flow";

void FixMassflowLsdcd::reduce()
{
  if (reduced) return;
  MPI_Allreduce(mine.data(), totals.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM,
                world);
  reduced = true;
}

double FixMassflowLsdcd::net_mass()
{
  reduce();
  double net = 0;
  for (int type = 0; type < size_array_rows; type++)
    net += totals[kColumns * type + kForwardMass] - totals[kColumns * type + kBackwardMass];
  return net;
}

void FixMassflowLsdcd::end_window()
{
  const double net = net_mass();
  window = {0, 0, net, (net - window.start) / window.time};
}

double FixMassflowLsdcd::compute_array(int type, int column)
{
  reduce();
  return totals[kColumns * type + column];
}

double FixMassflowLsdcd::compute_vector(int i)
{
  reduce();
  if (i == kColumns) return net_mass();
  if (i == kColumns + 1) return window.rate;
  if (i > kColumns + 1) return totals[kColumns * size_array_rows + i - kColumns - 2];
  double sum = 0;
  for (int type = 0; type < size_array_rows; type++) sum += totals[kColumns * type + i];
  return sum;
}

void FixMassflowLsdcd::write_restart(FILE *file)
{
  reduce();
  if (comm->me != 0) return;
  lsdcd::State state(kKind);
  state.add("totals", 1, totals);
  state.add("rate", 1, window);
  write_state(file, state);
}

// The first process keeps the totals.
void FixMassflowLsdcd::restart(char *buffer)
{
  const auto *numbers = reinterpret_cast<const double *>(buffer);
  std::vector<double> there;
  Window then;
  try {
    const lsdcd::State state(kKind, numbers, kAllNumbers);
    state.read("totals", 1, there);
    state.read("rate", 1, then);
    const std::string unread = unread_state(state);
    if (!unread.empty()) warn(unread);
  } catch (const lsdcd::StateError &e) {
    fatal(unusable_state(e, "what has passed"));
  }
  if (there.size() != mine.size()) {
    warn(
        "totals begin at zero: the restart file was written with a different number of atom types");
    return;
  }
  window = then;
  if (comm->me == 0) mine = there;
  reduced = false;
}
