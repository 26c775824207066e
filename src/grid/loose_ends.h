// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Ends of a mesh that face each other across a periodic face of the box and do not meet.
#pragma once

#include "mesh/mesh_features.h"
#include "mesh/periodic_box.h"

#include <cstddef>

namespace lsdcd {

struct LooseEnds {
  std::size_t edges = 0;    // of the mesh
  Real widest = 0;          // length; of the gaps
  int axis = 0;             // the edge of the box along which the widest gap is
};

// Finds open edges that face an image across a periodic face, with a gap of at most `widest` (length)
// in between. A part of the mesh that meets an image of itself somewhere along that axis is left
// out: its open edges there are holes. `mesh` is the mesh with its images, `wall` has its
// records.
LooseEnds loose_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall, const PeriodicBox &box,
                     Real widest);

}    // namespace lsdcd
