// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The triangles of a mesh without their neighbours, to be placed or sent, and welded anew.
#pragma once

#include "mesh/welded_mesh.h"

namespace lsdcd {

// Faces in their order, then facets that are none; then edges and vertices without a face, as triangles without area.
TriangleSoup soup_of(const WeldedMesh &mesh);

}    // namespace lsdcd
