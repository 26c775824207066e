// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Whether a mesh is the same as another one was, in 64 bits.
#pragma once

#include "mesh/wall_mesh.h"

#include <cstdint>

namespace lsdcd {

// Of what is numbered, where it is and in which order, bit for bit: vertices, edges and faces.
std::uint64_t fingerprint(const WallMesh &mesh);

}    // namespace lsdcd
