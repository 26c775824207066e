// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One mesh of a wall, as an engine has it.
#pragma once

#include "grid/lookup/grid_on.h"
#include "motion/pose.h"

namespace lsdcd {

template <class B>
struct EngineMesh {
  GridOn<B> grid;
  Pose pose, chosen;    // chosen: at the last choice
};

// What making lists needs of it, where kernels run.
struct PlacedGrid {
  GridView grid;
  Pose pose;
};

}    // namespace lsdcd
