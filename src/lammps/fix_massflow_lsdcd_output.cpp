// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Totals of fix massflow/lsdcd: over all processes, as output, and in restart files.

#include "lammps/fix_massflow_lsdcd.h"

#include "comm.h"

#include <cstring>

using namespace LAMMPS_NS;

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
  rate = (net - window_start) / window_time;
  window_start = net;
  window_time = 0;
  window_steps = 0;
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
  if (i == kColumns + 1) return rate;
  if (i > kColumns + 1) return totals[kColumns * size_array_rows + i - kColumns - 2];
  double sum = 0;
  for (int type = 0; type < size_array_rows; type++) sum += totals[kColumns * type + i];
  return sum;
}

// Types, the window of the rate, then all totals.
void FixMassflowLsdcd::write_restart(FILE *file)
{
  reduce();
  if (comm->me != 0) return;
  std::vector<double> data = {double(size_array_rows), window_time, double(window_steps),
                              window_start, rate};
  data.insert(data.end(), totals.begin(), totals.end());
  const int bytes = static_cast<int>(data.size() * sizeof(double));
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(data.data(), sizeof(double), data.size(), file);
}

// LAMMPS hands the same bytes to every process; the first one keeps the totals.
void FixMassflowLsdcd::restart(char *buffer)
{
  double header[5];
  std::memcpy(header, buffer, sizeof header);
  if (header[0] != size_array_rows) {
    warn("totals begin at zero: the restart file was written with another number of atom types");
    return;
  }
  window_time = header[1];
  window_steps = static_cast<int>(header[2]);
  window_start = header[3];
  rate = header[4];
  if (comm->me == 0) std::memcpy(mine.data(), buffer + sizeof header, mine.size() * sizeof(double));
  reduced = false;
}
