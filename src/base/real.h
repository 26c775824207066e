// Number type and function marker shared by host and device code.
#pragma once

#if defined(__CUDACC__)
#define LSDCD_FN __host__ __device__ inline
#define LSDCD_LAMBDA __host__ __device__
#else
#define LSDCD_FN inline
#define LSDCD_LAMBDA
#endif

namespace lsdcd {

using Real = double;

// Unit round-off of Real, for tolerances that are derived from it.
constexpr Real kRoundoff = 2.220446049250313e-16;

}    // namespace lsdcd
