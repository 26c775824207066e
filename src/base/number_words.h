// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers in text, with a point in every locale.
#pragma once

#include "base/real.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsdcd {

// Reads a whole word: digits with a decimal point, an exponent after e or E, a sign. A number nearer to 0
// than any Real is 0, one beyond all of them, inf and nan are not finite. False: it is something else, and
// `value` stays.
bool read_real(std::string_view word, Real &value);

// As read_real(), but false if the number is not finite, too.
bool is_number(std::string_view word, Real *value);

// Reads digits with a sign or without, and no more. False: it is something else, or beyond 64 bits.
bool read_integer(std::string_view word, std::int64_t &value);

std::string number_text(Real value);    // "0.001", six digits
std::string exact_text(Real value);     // with the fewest digits that read back as the same number

// "1 vertex", "2 vertices"; without `many` it is `one` with an s.
std::string counted(std::int64_t n, std::string_view one, std::string_view many = {});

}    // namespace lsdcd
