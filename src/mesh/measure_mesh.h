// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The counts and sizes of a welded mesh.
#pragma once

#include "mesh/face_plane.h"
#include "mesh/meets_itself.h"
#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

// Fills the edge counts, sizes, folds, area and volume of mesh.report; `plane`
// holds one entry per face. The welder counts what it drops.
void measure_mesh(WeldedMesh &mesh, const std::vector<FacePlane> &plane);

// Measures a mesh again whose vertices have moved, and whose faces and edges are as they were.
void measure_again(WeldedMesh &mesh);

// Sets the bounding box in mesh.report, for vertices that have moved.
void set_bounds(WeldedMesh &mesh);

// Does the face run along the edge from its lower to its higher vertex?
bool runs_along(const WeldedMesh &mesh, int face, int edge);

// Do as many of the faces at an edge run along it as against it?
bool runs_balance(const WeldedMesh &mesh, int edge);

// Notes in the report that these facets meet. A mesh with such facets is not oriented.
void note_meetings(WeldedMesh &mesh, const SelfMeetings &meetings);

// Squares of lengths outside 1e-100 .. 1e100 would leave the range of Real.
constexpr Real kLargestLength = 1e100;

// Returns the diagonal of the bounding box. Throws InputError where there is no facet, where a coordinate is no number or
// beyond kLargestLength, and where all are so small.
Real checked_diagonal(const TriangleSoup &soup);

// Throws InputError if no facet has an area: edges and points alone are no wall.
void check_has_area(const WeldedMesh &mesh);

}    // namespace lsdcd
