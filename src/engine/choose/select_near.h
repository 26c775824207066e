// Which spheres of a process are near the wall: one bit each, on the host.
#pragma once

#include "engine/wall_engine.h"
#include "grid/lookup/locate.h"

#include <vector>

namespace lsdcd {

// Indices, ascending, of the spheres in the group whose cell has candidates.
// Throws SphereError if one in the group feels the wall from further than the grid's reach
// (`pull_off`: of the law, at a radius of 1). `scratch` keeps its memory from call to call.
void select_near(const GridView &grid, const Spheres &spheres, Real pull_off,
                 std::vector<int> &near, std::vector<int> &scratch);

// The error for sphere i, which reaches further than the grid.
[[noreturn]] void throw_too_large(int i, Real radius, Real reach);

}    // namespace lsdcd
