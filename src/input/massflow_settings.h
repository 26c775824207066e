// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of fix massflow/lsdcd -> MassflowSettings.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct MassflowSettings {
  MeshSpec surface;        // file, placement and weld
  bool brief = false;      // one line in the log
  bool once = false;       // a sphere counts the first time only
  bool deletes = false;    // what has passed forward
  bool clumps = false;     // atoms of a molecule are one grain
  int every = 1000;        // steps over which the rate is an average
  std::string file;        // of rows of passages; empty: none
};

// Throws InputError that names the word, what was expected and the syntax.
MassflowSettings parse_massflow(const std::vector<std::string> &tokens);

}    // namespace lsdcd
