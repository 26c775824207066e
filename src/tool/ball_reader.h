// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Spheres from a file.
#pragma once

#include "clump/ball.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns the spheres of a file with a line x y z radius each, in lengths of the file times the scale (> 0): numbers between blanks,
// commas or semicolons. The first line may name the columns, and what is behind # is left out. Throws InputError with the file, the line, the value and the
// remedy.
std::vector<Ball> read_balls(const std::string &file, double scale);

}    // namespace lsdcd
