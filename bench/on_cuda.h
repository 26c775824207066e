// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the benchmarks do on a GPU themselves.
#pragma once

#include "brute_force.h"

#include "query/sphere.h"
#include "query/triangle_tree.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

double cuda_copy_gb_s();
// Of each run of a tree's query for the distances of points: milliseconds. Points come and distances go once.
std::vector<double> cuda_tree_ms(const TriangleTree &tree, const std::vector<Sphere> &points,
                                 int repeats, std::vector<double> &distance);
double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride);

}    // namespace lsdcd
