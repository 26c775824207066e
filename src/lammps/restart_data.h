// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The data of our fixes in LAMMPS's restart files.
#ifndef LMP_LSDCD_RESTART_DATA_H
#define LMP_LSDCD_RESTART_DATA_H

#include "base/countable.h"
#include "base/state_blocks.h"

#include "atom.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// LAMMPS hands the same numbers to every process, and does not say how many.
constexpr std::size_t kAllNumbers = std::size_t(1) << 40;

// Writes a state; called by the first process. Throws if LAMMPS's file has no room for so many numbers.
inline void write_state(FILE *file, const lsdcd::State &state)
{
  const std::vector<double> numbers = state.numbers();
  const int bytes =
      lsdcd::countable(numbers.size() * sizeof(double), "bytes of a fix in a restart file",
                       "LAMMPS has no room for more");
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(numbers.data(), sizeof(double), numbers.size(), file);
}

// Returns the error if a state cannot be used. `without`: what a fix with another ID begins without.
inline std::string unusable_state(const lsdcd::StateError &e, const std::string &without)
{
  return std::string("the restart file cannot be used: ") + e.what() +
         ": go on with the version that wrote it, or give the fix another ID to begin without " +
         without;
}

// Returns the warning if a later version has written more; empty: this version has read all.
inline std::string unread_state(const lsdcd::State &state)
{
  const std::string names = state.unread();
  return names.empty() ? ""
                       : "the restart file has " + names +
                             ", which this version does not know: it is not carried over";
}

// What a fix has written for an atom behind the first number, which is how many there are with it.
struct RestartRow {
  const double *numbers;
  int size;
};

// Throws the error for a damaged row of an atom. `without`: what is to be done to begin without the data.
[[noreturn]] inline void fail_at_row(const Atom &atom, int i, const char *what, const char *without)
{
  throw lsdcd::InputError(std::string("the ") + what + " of atom " + std::to_string(atom.tag[i]) +
                          " in the restart file are damaged: " + without);
}

// Returns what fix number `nth` of those with rows has written for atom i. Throws InputError if the row would end past what LAMMPS has read
// for the atom, whose rows lie one behind the other.
inline RestartRow restart_row(const Atom &atom, int i, int nth, const char *what,
                              const char *without)
{
  const double *row = atom.extra[i];
  for (int left = atom.nextra_store;; nth--) {
    const double size = left > 0 ? row[0] : 0;
    if (!(size >= 1 && size <= left) || size != std::floor(size))
      fail_at_row(atom, i, what, without);
    if (nth == 0) return {row + 1, static_cast<int>(size) - 1};
    row += static_cast<int>(size);
    left -= static_cast<int>(size);
  }
}

}    // namespace LAMMPS_NS

#endif
