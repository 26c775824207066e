// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// One mesh of a wall, as an engine has it.
#pragma once

#include "grid/lookup/grid_on.h"
#include "motion/wall_pose.h"

namespace lsdcd {

template <class B>
struct EngineMesh {
  GridOn<B> grid;
  WallPose pose, chosen;    // chosen: at the last choice
};

// What making lists needs of it, where kernels run.
struct PlacedGrid {
  GridView grid;
  WallPose pose;
};

}    // namespace lsdcd
