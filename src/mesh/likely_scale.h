// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The factor that a mesh file in other units than the script's was probably meant to have.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

// `mesh` and `box` are extents (length). The result is 1 unless the mesh is many times larger than the
// box along every axis in which it has an extent. Then it is the factor between two common units of
// length that makes the extents similar.
Real likely_scale(const Vec3 &mesh, const Vec3 &box);

}    // namespace lsdcd
