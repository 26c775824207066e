// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cell lengths that a trade-off tries.
#pragma once

#include "grid/triangle_grid.h"
#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

// Half, once, twice and four times the default of nearest lists, and the default of these settings:
// ascending, to four digits so that a script can say them. None is above the cutoff, or takes more
// than the memory budget at least; where all do, the first coarser one.
std::vector<Real> lengths_to_try(const WeldedMesh &mesh, const GridSettings &settings);

// The next length of four digits that is no finer.
Real rounded_up(Real length);

}    // namespace lsdcd
