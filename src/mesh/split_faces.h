// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cuts faces in pieces at corners of neighbours that lie on their open sides (T-junctions), so that
// edges match.
#pragma once

#include "mesh/welded_mesh.h"

#include <array>
#include <cstddef>
#include <set>
#include <vector>

namespace lsdcd {

struct SplitFaces {
  std::vector<int> corners;     // three vertices for each face of the result, in the old winding
  std::vector<int> face_of;     // the face that each is a piece of
  std::size_t faces = 0;        // that were cut
  std::size_t junctions = 0;    // corners on sides of faces
  Real moved = 0;               // length; the largest distance of such a corner from its side
};

// Vertices of faces, ascending.
using CutBefore = std::set<std::array<int, 3>>;

// Cuts at corners of open edges within `tolerance` (a length) of another open edge. A cut that would
// give a degenerate or reversed piece is left out. Faces in `before` stay whole; those that are cut
// are added to it.
SplitFaces split_faces(const WeldedMesh &mesh, Real tolerance, CutBefore &before);

}    // namespace lsdcd
