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

// `field`: "meshes[1].law.mu"; `value`: as it is to be shown; `remedy`: a clause.
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
inline std::string in_quotes(const std::string &text)
{
  return "\"" + text + "\"";
}

// Returns a finite number from `least` to `most`.
inline double checked_number(double value, const std::string &field, double least = -Tokens::kHuge,
                             double most = Tokens::kHuge)
{
  if (!std::isfinite(value)) refuse_field(field, value, "give a finite number");
  if (!(value >= least && value <= most))
    refuse_field(field, value, "it is " + range_text(least, most));
  return value;
}

inline double checked_number(double value, const std::string &field, const NumberRange &in)
{
  return checked_number(value, field, in.least, in.most);
}
// As this, or `otherwise` where it is 0.
inline double number_or(double otherwise, double value, const std::string &field,
                        const NumberRange &in)
{
  if (value == 0) return otherwise;
  if (std::isfinite(value) && !(value >= in.least && value <= in.most))
    refuse_field(field, value, "it is " + range_text(in.least, in.most) + ", or 0 for the default");
  return checked_number(value, field);
}
// Returns a number of steps; 0 is `none`, as "there are no means".
inline int steps_or_none(int value, const std::string &field, const std::string &none,
                         const NumberRange &in)
{
  if (value != 0 && value < in.least)
    refuse_field(field, std::to_string(value), "it is a number of steps, or 0: " + none);
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
