// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How a mesh meets the plane z = 0, in which the particles of a two-dimensional run move.
#pragma once

#include "mesh/welded_mesh.h"

#include <cstddef>

namespace lsdcd {

struct PlaneCut {
  std::size_t leaning = 0;    // faces that reach the plane and are not upright
  Real lean = 0;              // degrees from upright, the most of them
};

PlaneCut plane_cut(const WeldedMesh &mesh);

}    // namespace lsdcd
