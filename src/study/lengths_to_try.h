// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cell lengths that a trade-off tries.
#pragma once

#include "grid/triangle_grid.h"
#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

// Lengths of cells to try: 1/2, 1, 2 and 4 times the default of nearest lists, the defaults on a CPU and on a GPU, and that of
// `settings`, in ascending order and with 4 digits, so that a script can write them. Lengths above the cutoff are left out, and so are
// those that surely need more than the memory budget; if all do, the next coarser one is tried.
std::vector<Real> lengths_to_try(const WeldedMesh &mesh, const StepGridSettings &settings);

// The next length of four digits that is no finer.
Real rounded_up(Real length);

}    // namespace lsdcd
