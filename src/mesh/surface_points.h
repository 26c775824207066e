// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points all over the surface of a mesh.
#pragma once

#include "mesh/welded_mesh.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Returns the vertices, and points on edges and faces: these are cut at the middle of their longest edge until no edge is
// longer than `apart` (length, > 0). The same on all machines. Every point of the surface is within apart / sqrt(3) of
// one of them: a triangle whose edges are not longer than a is covered by three discs of radius a / sqrt(3) about its
// corners. Empty: there would be more than `most`.
std::vector<Vec3> surface_points(const WeldedMesh &mesh, Real apart, std::size_t most);

}    // namespace lsdcd
