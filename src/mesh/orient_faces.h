// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Windings that agree, and normals of closed shells that point out of what they bound.
#pragma once

#include "mesh/meets_itself.h"
#include "mesh/wall_mesh.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

struct OrientedFaces {
  std::vector<char> turned;     // for each face: it has to be wound the other way
  std::size_t faces = 0;        // of these
  std::size_t shells = 0;       // that are closed and can be oriented
  std::size_t cavities = 0;     // of these, with normals in: an odd number of others are round them
  std::size_t one_sided = 0;    // parts that no turning can orient, as a Moebius strip
};

// Parts of the mesh hang together by edges of two faces. A closed one points out, or where it
// bounds a cavity of others, into that; of another the side is kept that more of its area has.
OrientedFaces orient_faces(const WallMesh &mesh);

// Why the closed shells of a mesh have no inside in common.
struct ShellFaults {
  // Faces of shells that point in where the others, which are more, point out, or the other way
  // round.
  std::size_t inverted_faces = 0;
  SelfMeetings meetings;    // of faces of different shells
};

// Of a closed mesh whose windings agree along its edges.
ShellFaults faults_of_shells(const WallMesh &mesh);

}    // namespace lsdcd
