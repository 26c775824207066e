// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Faces cut in pieces where corners of their neighbours lie on their open sides (T-junctions), so
// that edges match.
#pragma once

#include "mesh/wall_mesh.h"

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace lsdcd {

struct SplitFaces {
  std::vector<int> corners;     // three vertices for each face of the result, in the old winding
  std::vector<int> face_of;     // the face that each is a piece of
  std::size_t faces = 0;        // that were cut
  std::size_t junctions = 0;    // sides of faces times corners on them
  Real moved = 0;               // length; the farthest that such a corner was from its side
};

// Vertices of faces, ascending.
using CutBefore = std::set<std::array<int, 3>>;

// By corners of open edges no farther than `tolerance` (a length) from another open edge. No piece
// is degenerate or turned over: where one would be, the corner is left where it is. A face of
// `before` is left whole; those that are cut join it.
SplitFaces split_faces(const WallMesh &mesh, Real tolerance, CutBefore &before);

}    // namespace lsdcd
