// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// `material` in a fix's words, on all processes.
#pragma once

#include "input/fill_material.h"

#include <mpi.h>

namespace lsdcd {

// fill_material() on the first process of `world`, which alone reads files; the words on
// all of them, the report on the first. Collective; throws InputError on all.
FilledTokens fill_material(MPI_Comm world, const std::vector<std::string> &tokens,
                           const std::string &units);

}    // namespace lsdcd
