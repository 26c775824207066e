// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Number type and function markers shared by CPU and device code.
#pragma once

#include <cmath>

#if defined(__CUDACC__)
#define LSDCD_FN __host__ __device__ inline
#define LSDCD_LAMBDA __host__ __device__
#define LSDCD_NOINLINE __host__ __device__ __noinline__
#else
#define LSDCD_FN inline
#define LSDCD_LAMBDA
#define LSDCD_NOINLINE __attribute__((noinline))
#endif

namespace lsdcd {

using Real = double;

// The overload for float where the argument is one, on both sides.
using std::fabs;
using std::fmax;
using std::fmin;
using std::sqrt;

// Return the larger and the smaller of two numbers; b where a is none. On a CPU these are an instruction, and fmax() and fmin()
// are calls.
LSDCD_FN Real larger(Real a, Real b)
{
  return a > b ? a : b;
}
LSDCD_FN Real smaller(Real a, Real b)
{
  return a < b ? a : b;
}

constexpr Real kPi = 3.14159265358979323846;

// Unit round-off of Real, for tolerances that are derived from it.
constexpr Real kRoundoff = 2.220446049250313e-16;

}    // namespace lsdcd
