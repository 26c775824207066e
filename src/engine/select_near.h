// Which spheres of a process are near the wall: one bit each, on the host.
#pragma once

#include "engine/wall_engine.h"
#include "grid/locate.h"

#include <vector>

namespace lsdcd {

// Indices, ascending, of the spheres in the group whose cell has candidates.
// Throws InputError if one in the group is larger than the grid's reach.
// `scratch` keeps its memory from call to call.
void select_near(const GridView &grid, const Spheres &spheres, std::vector<int> &near,
                 std::vector<int> &scratch);

}    // namespace lsdcd
