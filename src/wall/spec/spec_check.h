// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What of a WallSpec contradicts itself.
#pragma once

#include "wall/spec/wall_spec.h"

namespace lsdcd {

// Throws InputError, which names the mesh and the keyword, where a wall cannot be made of this. That each number is in its own
// range is for those who read it.
void check_spec(const WallSpec &wall);
// Throws where a body cannot begin where its mesh is: of a wall that no saved state follows, which may have it elsewhere.
void check_begin(const WallSpec &wall);

}    // namespace lsdcd
