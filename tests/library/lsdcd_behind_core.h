// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// lsdcd.hpp for tests that use the core, too. Both have a Pose, a Wall and more, so that headers of the core come
// first; tests call the library's api::Pose.
#pragma once

#include "support/fake_host.h"
#include "wall/move/mesh_motion.h"
#include "wall/saved/wall_state.h"

#include "lsdcd.hpp"

namespace api = lsdcd::cpp_api;
