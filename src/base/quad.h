// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A number of 113 bits of mantissa. On 64-bit Arm and others it is long double; compilers for x86-64
// have a type of their own for it.
#pragma once

#include <cfloat>

namespace lsdcd {

#if LDBL_MANT_DIG >= 113
using Quad = long double;
#else
using Quad = __float128;
#endif

}    // namespace lsdcd
