// What a call of liblsdcd costs by itself, on one core: of few points, and of a body's pose.
#pragma once

#include "bench.h"

namespace lsdcd {

void measure_calls(const BenchOptions &options, BenchRows &rows);

}    // namespace lsdcd
