// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers appended to the bytes of a file.
#pragma once

#include "base/vec3.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace lsdcd {

// Little-endian whatever the machine is; of 4 or 8 bytes.
template <class Number>
void append_number(std::string &bytes, Number x)
{
  std::conditional_t<sizeof x == 8, std::uint64_t, std::uint32_t> bits;
  static_assert(sizeof bits == sizeof x, "the same bits");
  std::memcpy(&bits, &x, sizeof bits);
  for (unsigned shift = 0; shift < 8 * sizeof bits; shift += 8)
    bytes += static_cast<char>(bits >> shift & 255);
}

template <class Number>
void append_numbers(std::string &bytes, const Vec3 &a)
{
  for (const Real x : {a.x, a.y, a.z}) append_number(bytes, static_cast<Number>(x));
}

// A line with a word and three numbers, each with the fewest digits that read back the same.
inline void append_line(std::string &bytes, const char *first, const Vec3 &a)
{
  bytes += first;
  for (const Real x : {a.x, a.y, a.z}) {
    char digits[32];
    if (bytes.back() != '\n') bytes += ' ';
    bytes.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
  }
  bytes += '\n';
}

}    // namespace lsdcd
