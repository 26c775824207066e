// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the benchmarks do on a GPU themselves.
#pragma once

#include "brute_force.h"

#include <cstddef>
#include <string>

namespace lsdcd {

std::string cuda_name();
double cuda_copy_gb_s();
double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride);

}    // namespace lsdcd
