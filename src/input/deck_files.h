// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files that commands of a deck read and write, and where one would replace another.
#pragma once

#include "input/settings.h"

#include <string>
#include <vector>

namespace lsdcd {

struct DeckFile {
  std::string what;    // "mesh", or another keyword that names it
  std::string name;    // with '*' for the step, where each such step has one
  int every = 0;       // steps, where it is written again and again
  bool written = false;
};

// Of the meshes of a wall; no more than their names.
std::vector<DeckFile> files_of(const WallSettings &settings);

// Would writing one of these, in a step after `now`, replace the other? However their folders are
// spelled: a file takes the place of a link, not of what that leads to.
bool are_one_file(const DeckFile &a, const DeckFile &b, long long now);

}    // namespace lsdcd
