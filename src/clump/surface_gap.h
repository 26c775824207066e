// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How far the surfaces of a mesh and of a clump are apart.
#pragma once

#include "clump/ball.h"
#include "clump/inside_mesh.h"

#include <vector>

namespace lsdcd {

struct SurfaceGap {
  Real uncovered = 0;    // greatest distance of a point of the mesh from the clump
  Real apart = 0;        // which may be so much larger between the points that were tried
  Real stick_out = 0;    // greatest distance from the mesh to which a sphere can reach outside
};

// Returns these lengths for spheres that stand for a mesh. Points of the mesh are tried all over it (surface_points()), about 20 000.
// A sphere reaches its radius less the depth of its centre, at most.
SurfaceGap surface_gap(const InsideMesh &inside, const std::vector<Ball> &balls);

}    // namespace lsdcd
