// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Makes windings agree, and the normals of closed shells point out of the solid that they bound.
#pragma once

#include "mesh/meets_itself.h"
#include "mesh/welded_mesh.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

struct OrientedFaces {
  std::vector<char> turned;     // for each face: its winding has to be reversed
  std::size_t faces = 0;        // of these
  std::size_t shells = 0;       // parts that are closed and can be oriented
  std::size_t cavities = 0;     // of these, cavities: an odd number of others encloses them
  std::size_t one_sided = 0;    // parts that cannot be oriented, as a Moebius strip
};

// A part is connected by edges with two faces. The normals of a closed part point out or, if it bounds a
// cavity of others, into the cavity. An open part keeps the side that most of its area has.
OrientedFaces orient_faces(const WeldedMesh &mesh);

// Why the closed shells of a mesh do not bound a common inside.
struct ShellFaults {
  // Faces of shells that point in while most others point out, or the other way
  // round.
  std::size_t inverted_faces = 0;
  SelfMeetings meetings;    // of faces of different shells
};

// Returns the faults of the shells of a closed mesh whose windings agree along its edges.
ShellFaults faults_of_shells(const WeldedMesh &mesh);

}    // namespace lsdcd
