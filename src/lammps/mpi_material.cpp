// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/mpi_material.h"

#include "lammps/mpi_shared.h"

namespace lsdcd {

FilledTokens fill_material(MPI_Comm world, const std::vector<std::string> &tokens,
                           const std::string &units)
{
  int rank;
  MPI_Comm_rank(world, &rank);
  FilledTokens filled;
  run_collectively(world, rank == 0, [&] { filled = fill_material(tokens, units); });

  std::string text;    // each word with a NUL, which none can contain
  for (const std::string &word : filled.tokens) text.append(word.c_str(), word.size() + 1);
  broadcast_text(text, 0, world);
  filled.tokens.clear();
  for (std::size_t at = 0; at < text.size(); at += filled.tokens.back().size() + 1)
    filled.tokens.push_back(text.c_str() + at);
  return filled;
}

}    // namespace lsdcd
