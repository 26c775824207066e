// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arguments of fix_modify -> changes of a wall.
#pragma once

#include "input/program_words.h"
#include "wall/wall.h"

#include <string>
#include <vector>

namespace lsdcd {

// K: the number of a mesh, from 1, or its name. [mesh K] motion ... [motion ...] | motion none, or [mesh K] servo ... | servo none: another motion or servo for
// a mesh; [mesh K] body ...: what holds and drives a body. Returns how many arguments it took; 0: the first is no argument of a wall. `program`: whose
// values the arguments have; null: they are a script's. Throws InputError that names the argument, and changes nothing then. Collective.
int change_wall(Wall &wall, const std::vector<std::string> &arguments, const Step &now,
                const ProgramWords *program = nullptr);

// Returns whether the arguments are [mesh K] names ..., and takes away what stands before `names`. `mesh`: counted from 0; -1: none is given.
// Throws InputError where there is no such mesh.
bool asks_for_names(const Wall &wall, std::vector<std::string> &arguments, int &mesh);

}    // namespace lsdcd
