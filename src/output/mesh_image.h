// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh drawn with few lines that show its shape and leave the grains visible.
#pragma once

#include "mesh/welded_mesh.h"

#include <vector>

namespace lsdcd {

enum class Draw {
  edges,    // open edges and folds above 30 degrees; contours where there are none
  faces,
  contours    // cuts by planes across the bounding box
};

// A line (two corners) or, for Draw::faces, a triangle (three).
struct ImageObject {
  Vec3 corner[3];
};

std::vector<ImageObject> draw_mesh(const WeldedMesh &mesh, Draw what);

}    // namespace lsdcd
