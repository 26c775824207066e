// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A sphere of a clump.
#pragma once

#include "base/vec3.h"

namespace lsdcd {

struct Ball {
  Vec3 centre;    // length
  Real radius;    // length, > 0
};

}    // namespace lsdcd
