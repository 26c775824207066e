// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall is made of, as texts by which saved data are known to be of another one.
#pragma once

#include "wall/wall.h"

#include <string>
#include <vector>

namespace lsdcd {

// Names and texts of what a wall's steps and the means over them depend on: {"law", "hooke/history 10000 ..."}. A third text is
// of numbers that the second one has not with all digits. What changes no number is left out. All walls have the same names, but for
// those of meshes, "law of meshes[1]".
using WallParts = std::vector<std::vector<std::string>>;
// What it was made of, in this box.
WallParts made_parts(const Wall &wall, const PeriodicBox &box);
// What may be set later: motions and servos, and bodies with what holds and drives them.
WallParts set_parts(const Wall &wall);

// "the law is X and was Y; ..."; empty: they are of such a wall. What only one of them has is "none" in the other; of a mesh that only
// one has the number of meshes tells.
std::string differences(const WallParts &is, const WallParts &was);

}    // namespace lsdcd
