// Lists of the N nearest primitives from lists of more.
#pragma once

#include "grid/triangle_grid.h"

namespace lsdcd {

// What a build with `nearest` would make, bit for bit, from the lists of a build with as
// many or more: a list ascends, so the nearest few and the bound are its beginning.
CellLists shorten(const CellLists &lists, int nearest);

}    // namespace lsdcd
