// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/own_messages.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <cstdio>

using namespace LAMMPS_NS;

std::vector<std::string> OwnMessages::words_of(char **first, char **end)
{
  std::vector<std::string> words(first, end);
  for (const std::string &word : words)
    if (word == "&" || (&word == &words.back() && !word.empty() && word.back() == '&'))
      throw lsdcd::InputError("the command ends at '&', because something follows on its line, as "
                              "a comment: LAMMPS continues a line only if '&' is "
                              "its last character, so put the comment on a line of its own");
  return words;
}

void OwnMessages::log(const std::string &text) const
{
  if (lammps->comm->me == 0) utils::logmesg(lammps, begin + text + "\n");
}

void OwnMessages::warn(const std::string &problem) const
{
  if (lammps->comm->me == 0) lammps->error->warning(FLERR, begin + problem);
}

void OwnMessages::fatal(const std::string &problem) const
{
  lammps->error->all(FLERR, begin + problem);
}

void OwnMessages::fatal_here(const std::string &problem) const
{
  // Error::one of 7Feb2024 and 29Aug2024 ends the program without writing what is buffered, and a pipe
  // or a log file is: from here on each line is written when it ends.
  for (FILE *file : {lammps->screen, lammps->logfile})
    if (file) std::setvbuf(file, nullptr, _IOLBF, 0);
  lammps->error->one(FLERR, begin + problem);
}
