// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The second half of welding: from points and facets to faces, edges and their neighbours.
#pragma once

#include "mesh/welded_mesh.h"

#include <array>
#include <string>
#include <vector>

namespace lsdcd {

// Faces and edges over `vertices`; `corners` has three vertices for each facet. Degenerate
// and duplicate facets are dropped as faces. `bare_edges` are edges that need no face. Edges
// ascend in their vertices. The edges of vertices and the report are left to the caller, but for
// the counts of what was dropped.
WeldedMesh assemble(std::vector<Vec3> vertices, const std::vector<int> &corners,
                    std::vector<std::array<int, 2>> bare_edges);

// As weld(), but edges ascend in their vertices, the edges of vertices are left to the caller, and nothing is measured
// but what was dropped and closed. Facets may collapse. `corner_vertex` becomes the vertex of each corner.
WeldedMesh join_corners(const TriangleSoup &soup, Real tolerance, std::vector<int> &corner_vertex);

// Throws InputError where the ends of n edges are more than an int can number.
void check_edge_number(std::size_t n, const std::string &source);

// Gives edge e the number number[e]. The edges of vertices are left to the caller.
void number_edges(WeldedMesh &mesh, const std::vector<int> &number);

// Fills vertex_first and vertex_edge from the edges.
void connect_vertices(WeldedMesh &mesh);

}    // namespace lsdcd
