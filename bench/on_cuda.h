// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What only a file that nvcc compiles can measure.
#pragma once

struct lsdcd_grid;
struct lsdcd_query;

namespace lsdcd {

// Bytes read and written per second by copying a large block on the current device, in units of 1e9.
double cuda_copy_gb_s();

// Milliseconds of distances in double on the device of a grid, after one run to warm up. Arrays are the CPU's, of x y z r and of
// distances; copies are not timed.
double cuda_query_ms(const lsdcd_grid *grid, lsdcd_query query);

}    // namespace lsdcd
