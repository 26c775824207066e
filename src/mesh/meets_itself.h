// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Where a mesh meets itself.
#pragma once

#include "mesh/welded_mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lsdcd {

struct SelfMeetings {
  std::size_t pairs = 0;                  // of faces
  std::array<int, 2> first = {-1, -1};    // the pair with the lowest numbers
};

// Finds pairs of faces that have more in common than shared corners and edges: they cut, overlap or
// touch each other. It is exact for the corners as they are. Periodic images are left out.
SelfMeetings meets_itself(const WeldedMesh &mesh);

// Returns all pairs that meets_itself() counts, each with its lower number first, in ascending order.
std::vector<std::array<int, 2>> meeting_faces(const WeldedMesh &mesh);

// Finds pairs of faces of different shells that have more in common than shared corners and edges. A shell is given by
// the numbers of its faces. Shells with boxes that do not overlap cost nothing.
SelfMeetings shells_meet(const WeldedMesh &mesh, const std::vector<std::vector<int>> &shells);

}    // namespace lsdcd
