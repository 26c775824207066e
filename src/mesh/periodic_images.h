// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall that acts through the periodic faces of a box, by images of its triangles.
#pragma once

#include "mesh/periodic_box.h"
#include "mesh/wall_mesh.h"

namespace lsdcd {

// The mesh with the images of its triangles that come within `depth` (length) of the box, moved by
// sums of periodic edges and welded to it. What the mesh has keeps its number; images come
// behind (WallMesh::images). An image equal to a triangle of the mesh is dropped. The report
// stays that of the mesh, but for its bounds. Without such triangles it is the mesh itself.
WallMesh with_images(const WallMesh &mesh, const PeriodicBox &box, Real depth);

}    // namespace lsdcd
