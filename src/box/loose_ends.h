// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Ends of a mesh that face each other across a periodic face of the box and do not meet.
#pragma once

#include "box/periodic_box.h"
#include "mesh/mesh_features.h"

namespace lsdcd {

struct LooseEnds {
  Real gap = 0;    // length; the widest, 0 without any
  int axis = 0;    // the edge of the box along which it is
};

// Finds the mesh, or connected parts of it, that come to less than `cutoff` (length) from a periodic face, or past it, are shorter than the box
// there by at most `widest` (length), and have open edges that look to both sides. `mesh` is the mesh with its images, `wall`
// has its records.
LooseEnds loose_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall, const PeriodicBox &box,
                     Real cutoff, Real widest);
// Finds those that met themselves across a face of the box `before`, and do not in this one, however wide the gap is.
LooseEnds parted_ends(const WeldedMesh &mesh, const MeshFeaturesView &wall,
                      const PeriodicBox &before, const PeriodicBox &box);

}    // namespace lsdcd
