// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Restart data of versions before 0.10.0, where a motion was known by its words.
#pragma once

#include "wall/wall_state.h"

#include <cstddef>

namespace lsdcd {

// Reads at most n numbers that Wall::save() gave, those of State or those of versions before 0.10.0. Throws
// StateError, or InputError of the words of a motion.
WallState read_wall_state(const Real *numbers, std::size_t n);

}    // namespace lsdcd
