// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The facets of a mesh that winding numbers count, and the edges where they leave the surface open.
#pragma once

#include "geometry/triangles_meet.h"
#include "mesh/welded_mesh.h"

#include <array>
#include <vector>

namespace lsdcd {

// From vertex `from` to vertex `to` so many more facets run than back: >= 1.
struct LooseEdge {
  int from, to, times;
  int facets;    // that have it
};

// Where two facets have the same corners and opposite windings neither counts; where they are wound
// alike, one does. Facets without area count where they close the surface.
struct CountedFacets {
  std::vector<std::array<int, 3>> facets;    // vertices, as they are wound
  std::vector<int> sheets;                   // faces of which neither winding counts
  std::vector<LooseEdge> loose;              // none: the surface is closed

  explicit CountedFacets(const WeldedMesh &mesh);
};

// Do some of these faces enclose a space among themselves?
bool enclose(const WeldedMesh &mesh, const std::vector<int> &faces);

// Are all faces counted, and is no edge loose? Quick; false: not known.
bool is_known_closed(const WeldedMesh &mesh);

// The facets, and behind them all else of the mesh on which a point can lie, which adds nothing to a
// winding number: sheets in both windings, and edges and vertices without faces as triangles without area.
std::vector<Triangle> whole_surface(const WeldedMesh &mesh, const CountedFacets &counted);

}    // namespace lsdcd
