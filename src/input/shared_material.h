// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// `material` in the words of a wall, on all processes.
#pragma once

#include "host/host.h"
#include "input/fill_material.h"

#include <string>
#include <vector>

namespace lsdcd {

// fill_material() on the first process, which alone reads files; the words on all of them, the report on
// the first. Throws InputError on all. Collective.
FilledTokens fill_material(Host &host, const std::vector<std::string> &tokens,
                           const std::string &units);

}    // namespace lsdcd
