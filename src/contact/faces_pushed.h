// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The faces that a surface velocity would move along their normals, although the mesh stays at rest.
#pragma once

#include "mesh/welded_mesh.h"
#include "motion/surface_motion.h"

#include <cstddef>

namespace lsdcd {

struct PushReport {
  std::size_t faces = 0;    // faces that the motion pushes along their normals
  Real component = 0;       // the largest along a normal, at a face's centre; velocity
  Real share = 0;           // of the speed there
};

// A belt, a turntable, a roll or a cone has no such face, however coarse its triangles are (six around a
// roll are enough) and however thin. Lifters, blades, screws and tilted belts have some, and so may have
// slivers of a surface that also bends along its axis, as a sphere does.
PushReport faces_pushed(const WeldedMesh &mesh, const SurfaceMotion &motion);

}    // namespace lsdcd
