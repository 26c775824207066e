// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The faces that a surface velocity would move along their normals, although the mesh stays at rest.
#pragma once

#include "mesh/welded_mesh.h"
#include "motion/surface_motion.h"

#include <cstddef>

namespace lsdcd {

// Slivers of a smooth surface, whose planes lean, have a smaller share of its area.
constexpr Real kSlivers = 0.01;

struct PushReport {
  std::size_t faces = 0;    // faces that the motion pushes along their normals
  Real area = 0;            // of them, as a share of the mesh's
  Real component = 0;       // the largest along a normal, at a face's centre; velocity
  Real share = 0;           // of the speed there
};

// A flat face can be part of a smooth surface that moves along itself if the velocity lies in its plane at some point of it,
// as along the middle of a roll's facet; all others are pushed. So a belt, a turntable, a roll or a cone has no such face,
// however coarse its triangles are, but for slivers. Lifters, blades, screws and tilted belts have some. A box that turns
// about its middle is a coarse roll.
PushReport faces_pushed(const WeldedMesh &mesh, const SurfaceMotion &motion);

}    // namespace lsdcd
