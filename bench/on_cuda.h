// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Work of the benchmarks themselves on a GPU.
#pragma once

#include "brute_force.h"

#include "query/sphere.h"
#include "tree/triangle_tree.h"

#include <cstddef>
#include <string>
#include <vector>

struct lsdcd_grid;
struct lsdcd_query;

namespace lsdcd {

double cuda_copy_gb_s();
// Milliseconds of each run of a tree's query for the distances of points. Points come and distances go once.
std::vector<double> cuda_tree_ms(const TriangleTree &tree, const std::vector<Sphere> &points,
                                 int repeats, std::vector<double> &distance);
// Milliseconds of each run of a query of the library on a stream. Its arrays are copies on the GPU of those of the host
// that `q` has: x y z r of each point and, where `q` has them, their radii among these; `bytes` is the size of a number.
std::vector<double> cuda_query_ms(const lsdcd_grid *grid, lsdcd_query q, std::size_t bytes,
                                  int repeats);
double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride);

}    // namespace lsdcd
