// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The factor that a mesh file in other units than the script's was probably meant to have.
#pragma once

#include "box/periodic_box.h"

#include <string>

namespace lsdcd {

// `mesh` and `box` are extents (length). The result is 1 unless the mesh is many times larger than the
// box along every axis in which it has an extent. Then it is the factor from a unit of the metric system to metres with
// which the mesh fits into the box; from inches where nothing else fits.
Real likely_scale(const Vec3 &mesh, const Vec3 &box);

// Returns the end of a message, "; the file is probably in different units: add scale 0.001 if they are millimetres". Empty
// where the scale is likely right, and where a box that follows its spheres says nothing of it. `mesh`: extents.
std::string likely_scale_text(const Vec3 &mesh, const PeriodicBox &box);

// A message about a mesh that is far larger than the box and probably in different units; empty for others.
// `spans`: where the mesh is in the box.
std::string too_large_text(const Vec3 &mesh, const Box &spans, const PeriodicBox &box);

}    // namespace lsdcd
