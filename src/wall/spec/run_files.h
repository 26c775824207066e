// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files that a run reads and writes, and where one would replace another.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct RunFile {
  std::string what;    // "mesh", or another keyword that names it
  std::string name;    // with '*' for the step if each step has a file
  int every = 0;       // steps between two times that it is written
  bool written = false;
};

// Returns the files of a wall's meshes, by name; none is opened.
std::vector<RunFile> files_of(const WallSpec &settings);

// Returns whether writing one of these files in a step after `now` would replace the other. Different spellings of a folder are the same. A
// link is replaced, not the file that it leads to.
bool are_one_file(const RunFile &a, const RunFile &b, long long now);

// Throws InputError if writing `file` in a step after `now` would replace the other one, which `owner` reads or writes. A grid cache
// replaces other caches only.
void check_apart(const RunFile &file, const RunFile &other, const std::string &owner,
                 long long now);
// Throws InputError if writing one of these files would replace another one of them.
void check_apart(const std::vector<RunFile> &files, const std::string &owner, long long now);

}    // namespace lsdcd
