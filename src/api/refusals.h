// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Errors of a caller's structs. Each names the field, its value and what to give.
#pragma once

#include "api/c_border.h"
#include "base/input_words.h"
#include "base/vec3.h"

#include <cmath>
#include <string>

namespace lsdcd {

// `field`: "values[1].numbers"; `value`: as it is to be shown; `remedy`: a clause.
[[noreturn]] inline void refuse_field(const std::string &field, const std::string &value,
                                      const std::string &remedy)
{
  throw ApiError(LSDCD_ERROR_ARGUMENT, "`" + field + "` is " + value + ": " + remedy);
}
[[noreturn]] inline void refuse_field(const std::string &field, double value,
                                      const std::string &remedy)
{
  refuse_field(field, number_text(value), remedy);
}

inline std::string element(const std::string &array, std::size_t k)
{
  return array + "[" + std::to_string(k) + "]";
}
inline double checked_number(double value, const std::string &field)
{
  if (!std::isfinite(value)) refuse_field(field, value, "give a finite number");
  return value;
}

// Three finite numbers.
inline Vec3 checked_vector(const double *values, const std::string &field)
{
  Vec3 v;
  for (std::size_t k = 0; k < 3; k++)
    v[static_cast<int>(k)] = checked_number(values[k], element(field, k));
  return v;
}

// One of the values 0 to n - 1 of an enum, whose names are `names`.
inline int checked_choice(int value, const std::string &field, int n, const std::string &names)
{
  if (value < 0 || value >= n) refuse_field(field, std::to_string(value), "it is " + names);
  return value;
}
inline bool checked_flag(int value, const std::string &field)
{
  return checked_choice(value, field, 2, "0 or 1") != 0;
}

}    // namespace lsdcd
