// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of a call of liblsdcd by itself, on one core: of few points, and of a body's pose.
#pragma once

#include "bench.h"

namespace lsdcd {

void measure_calls(const BenchOptions &options, BenchRows &rows);

}    // namespace lsdcd
