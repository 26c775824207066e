// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances of points near a mesh, and of points far from it, by the library and by its peers.
#pragma once

#include "bench.h"

namespace lsdcd {

// On one core: a row a way, mesh, place and order.
void measure_near_and_far(const BenchOptions &options, BenchRows &rows);

// The same points, 1e7 of each kind, by the tree on a GPU.
void measure_tree_on_gpu(const BenchOptions &o, BenchRows &rows);

}    // namespace lsdcd
