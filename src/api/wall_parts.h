// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall is made of, as texts by which saved data are known to be of another one.
#pragma once

#include "wall/wall.h"

#include <string>
#include <vector>

namespace lsdcd {

// Names and texts of what a wall's steps depend on: {"law", "hooke/history 10000 ..."}. Numbers are exact. How it searches
// and what it writes are left out: they may differ.
using WallParts = std::vector<std::vector<std::string>>;
// What it was made of. A motion that is set later is in the data.
WallParts made_parts(const Wall &wall);
// What may be set later and is not in the data: servos, and bodies with what holds and drives them.
WallParts set_parts(const Wall &wall);

// "the law is X and was Y; ..."; empty: they are of such a wall.
std::string differences(const WallParts &is, const WallParts &was);

}    // namespace lsdcd
