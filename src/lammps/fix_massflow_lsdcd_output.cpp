// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Totals of fix massflow/lsdcd: over all processes, as output, and in restart files.

#include "lammps/fix_massflow_lsdcd.h"

#include "base/input_words.h"
#include "base/number_words.h"
#include "lammps/mpi_host.h"
#include "lammps/restart_data.h"

#include "atom.h"
#include "comm.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

static const char *const kKind = "mass flow";

void FixMassflowLsdcd::reduce()
{
  if (reduced) return;
  settle();
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

// Begins the file in the first run, or goes on in it.
void FixMassflowLsdcd::open_rows()
{
  if (settings.file.empty() || rows) return;
  rows = std::make_unique<lsdcd::PassFile>(settings.file);
  if (comm->me != 0) return;
  run_core_here([&] { rows->open(rows_before); });
  if (rows->rows() < rows_before)
    warn(settings.file + " has " + std::to_string(rows->rows()) + " of the " +
         lsdcd::counted(rows_before, "row") +
         " that it had when the restart file was written: rows of this run follow these");
}

void FixMassflowLsdcd::keep_row(lsdcd::Passage row, lsdcd::Passes passes)
{
  row.direction = 1;
  for (int k = 0; k < passes.forward; k++) passages.push_back(row);
  row.direction = -1;
  for (int k = 0; k < passes.backward; k++) passages.push_back(row);
}

// Collective.
void FixMassflowLsdcd::write_rows()
{
  settle();
  if (!rows) return;
  std::vector<double> numbers;
  for (const lsdcd::Passage &p : passages)
    numbers.insert(numbers.end(), {p.step, p.time, p.id, p.type, p.diameter, p.x.x, p.x.y, p.x.z,
                                   p.v.x, p.v.y, p.v.z, p.direction});
  passages.clear();
  const std::vector<double> all = lsdcd::MpiHost(world).gather(numbers);
  std::vector<lsdcd::Passage> written;
  for (std::size_t k = 0; k + 11 < all.size(); k += 12) {
    const double *a = &all[k];
    written.push_back(
        {a[0], a[1], a[2], a[3], a[4], {a[5], a[6], a[7]}, {a[8], a[9], a[10]}, a[11]});
  }
  if (!written.empty() && !rows->add(std::move(written)))
    fatal_here("the rows of step " + std::to_string(update->ntimestep) +
               " and before could not be written to " + settings.file + ": make room on its disk");
}

void FixMassflowLsdcd::post_run()
{
  write_rows();
}

void FixMassflowLsdcd::end_window()
{
  write_rows();
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

// [type I] names ...
int FixMassflowLsdcd::modify_param(int narg, char **arg)
{
  std::vector<std::string> words = words_of(arg, arg + narg);
  const bool of_type = words[0] == "type";
  if (!of_type && words[0] != "names") return 0;
  int type = 0;
  if (of_type) {
    lsdcd::Tokens w(words);
    w.set_context("fix_modify type", "fix_modify ID type I names PREFIX NAME ...");
    w.take();
    type = static_cast<int>(w.whole("the atom type", 1, size_array_rows));
    if (w.done() || w.peek() != "names") w.fail("names PREFIX NAME ... is missing");
    words.erase(words.begin(), words.begin() + 2);
  }
  variables.make(
      words,
      lsdcd::named_elements(of_type ? lsdcd::massflow_outputs_by_type() : lsdcd::massflow_outputs(),
                            false),
      type);
  return narg;
}

void FixMassflowLsdcd::write_restart(FILE *file)
{
  write_rows();
  reduce();
  if (comm->me != 0) return;
  lsdcd::State state(kKind);
  state.add("totals", 1, totals);
  state.add("rate", 1, window);
  const std::int64_t n_rows = rows ? rows->rows() : rows_before;
  if (n_rows > 0) state.add("rows", 1, n_rows);
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
    state.find("rows", 1, rows_before);
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
