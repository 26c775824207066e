// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a mesh meets itself.
#pragma once

#include "mesh/wall_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lsdcd {

struct SelfMeetings {
  std::size_t pairs = 0;                  // of faces
  std::array<int, 2> first = {-1, -1};    // the first of them, by their numbers
};

// Pairs of faces with more in common than the corners and edges that they share: they cut, overlap
// or touch each other. Exact, for the corners as they are; periodic images are left out.
SelfMeetings meets_itself(const WallMesh &mesh);

// The same between faces of different shells, of each the numbers of its faces. Those whose boxes
// are apart cost nothing.
SelfMeetings shells_meet(const WallMesh &mesh, const std::vector<std::vector<int>> &shells);

}    // namespace lsdcd
