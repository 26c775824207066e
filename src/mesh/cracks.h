// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cracks: corners of neighbouring facets that miss each other by rounding.
#pragma once

#include "mesh/welded_mesh.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

struct Cracks {
  // For each vertex, the one that it becomes: itself, or one before it. Empty: no crack is closed.
  std::vector<int> onto;
  std::size_t closed = 0;    // vertices that become another
  Real widest = 0;           // length; how far one of these moves at most
  // 1e-6 of the diagonal of the largest part of the mesh. A part is what edges connect, or gaps of 1e-6 of it.
  Real tolerance = 0;
  // Ends of open edges where facets are as small as the rounding of the file, and a step of its numbers there.
  std::size_t coarse = 0;
  Real step = 0;
};

// Finds which ends of open edges are one point, the nearest pairs first, in a mesh that has its faces and edges.
// Two are within 1e-6 of their part and a quarter of the shortest edge of a face at either; or within two steps of the
// file's numbers there and less than half that edge. So no face loses an edge. Each goes to a corner before it.
Cracks find_cracks(const WeldedMesh &mesh, const FileRounding &rounding);

}    // namespace lsdcd
