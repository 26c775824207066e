// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The way from corners and facets of a file to vertices and faces of the welded mesh.
#pragma once

#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

// As weld(soup, tolerance). `corner_vertex` becomes the vertex of each corner of the file; corners with the same
// coordinates have the same one.
WeldedMesh weld(const TriangleSoup &soup, Real tolerance, std::vector<int> &corner_vertex);

constexpr int kNoFace = -1, kNoVertex = -1;

// Returns the face of each facet of the file. A duplicate, in either winding, has the face that it equals, a facet
// without area kNoFace.
std::vector<int> faces_of_facets(const WeldedMesh &mesh, const std::vector<int> &corner_vertex);

// The vertex of the corners that are exactly at each of these positions; kNoVertex where none is.
std::vector<int> vertices_at(const std::vector<Vec3> &places, const std::vector<Vec3> &corners,
                             const std::vector<int> &corner_vertex);

}    // namespace lsdcd
