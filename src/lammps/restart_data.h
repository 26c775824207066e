// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The data of our fixes in LAMMPS's restart files.
#ifndef LMP_LSDCD_RESTART_DATA_H
#define LMP_LSDCD_RESTART_DATA_H

#include "base/countable.h"
#include "base/state_blocks.h"

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// LAMMPS hands the same numbers to every process, and does not say how many.
constexpr std::size_t kAllNumbers = std::size_t(1) << 40;

// The first process calls it. Throws where LAMMPS's file has no room for so many.
inline void write_state(FILE *file, const lsdcd::State &state)
{
  const std::vector<double> numbers = state.numbers();
  const int bytes =
      lsdcd::countable(numbers.size() * sizeof(double), "bytes of a fix in a restart file",
                       "LAMMPS has no room for more");
  fwrite(&bytes, sizeof bytes, 1, file);
  fwrite(numbers.data(), sizeof(double), numbers.size(), file);
}

// `without`: what a fix with another ID begins without.
inline std::string unusable_state(const lsdcd::StateError &e, const std::string &without)
{
  return std::string("the restart file cannot be used: ") + e.what() +
         ": go on with the version that wrote it, or give the fix another ID to begin without " +
         without;
}

// The log's warning where a later version has written more; empty: this version has read all.
inline std::string unread_state(const lsdcd::State &state)
{
  const std::string names = state.unread();
  return names.empty() ? ""
                       : "the restart file has " + names +
                             ", which this version does not know: it is not carried over";
}

}    // namespace LAMMPS_NS

#endif
