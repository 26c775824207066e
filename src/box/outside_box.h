// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Is a mesh where spheres can be? Texts for messages.
#pragma once

#include "box/periodic_box.h"

#include <string>

namespace lsdcd {

std::string extents_text(const Box &box);    // "x from 0 to 1, y from 0 to 2, z from 0 to 1"

// Empty where something of the mesh is nearer than `near` (length) to the box or, where faces are
// periodic, to one of its images; shrink-wrapped faces go wherever spheres go. Else what is wrong.
std::string outside_box(const Box &mesh, const PeriodicBox &box, Real near);

}    // namespace lsdcd
