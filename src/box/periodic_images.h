// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall that acts through the periodic faces of a box, by images of its triangles.
#pragma once

#include "box/periodic_box.h"
#include "mesh/welded_mesh.h"

namespace lsdcd {

// Returns the mesh with the images of its triangles within `depth` (length) of the box. Images are moved by sums of
// periodic edges and welded to the mesh. The parts of the mesh keep their numbers, and images follow
// (WeldedMesh::images). An image that equals a triangle of the mesh is dropped. The report is that of the mesh, except
// for its bounds. Without such triangles the result is the mesh.
WeldedMesh with_images(const WeldedMesh &mesh, const PeriodicBox &box, Real depth);

}    // namespace lsdcd
