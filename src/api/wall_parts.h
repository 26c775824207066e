// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall is made of, as texts by which saved data are known to be of another one.
#pragma once

#include "wall/wall.h"

#include <string>
#include <vector>

namespace lsdcd {

// Names and texts of what decides the springs, places and wear of a wall: {"law", "hooke/history 10000 ..."}. Numbers are
// exact. Search, files and names are left out: they may differ.
using WallParts = std::vector<std::vector<std::string>>;
WallParts parts_of(const Wall &wall);

// "the law is X and was Y; ..."; empty: they are of such a wall.
std::string differences(const WallParts &is, const WallParts &was);

}    // namespace lsdcd
