// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A number of 64 bits that tells whether a mesh is the same as an earlier one.
#pragma once

#include "mesh/welded_mesh.h"

#include <cstdint>

namespace lsdcd {

// Returns a number made of the bits of vertices, edges and faces, in their order.
std::uint64_t fingerprint(const WeldedMesh &mesh);

}    // namespace lsdcd
