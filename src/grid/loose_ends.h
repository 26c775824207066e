// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Ends of a mesh that face each other across a periodic face of the box and do not meet.
#pragma once

#include "mesh/periodic_box.h"
#include "mesh/wall_features.h"

#include <cstddef>

namespace lsdcd {

struct LooseEnds {
  std::size_t edges = 0;    // of the mesh
  Real widest = 0;          // length; of the gaps
  int axis = 0;             // the edge of the box along which the widest is
};

// Open edges that look across a periodic face, with nothing of an image at them but with some of
// one within `widest` (length) behind a gap. Parts of the mesh that meet an image of themselves
// somewhere along that axis are left out: what is open there was cut out of them. `mesh` has its
// images, `wall` its records.
LooseEnds loose_ends(const WallMesh &mesh, const WallFeaturesView &wall, const PeriodicBox &box,
                     Real widest);

}    // namespace lsdcd
