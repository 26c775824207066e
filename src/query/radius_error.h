// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The error for a radius above the grid's cutoff, below 0, or not a number.
#pragma once

#include "base/input_error.h"
#include "base/real.h"

#include <cstddef>
#include <cstdio>

namespace lsdcd {

struct RadiusError : InputError {
  using InputError::InputError;
};
// The error for a radius below 0, or not a number.
struct NegativeRadiusError : InputError {
  using InputError::InputError;
};

// Throws the error. `of`: the caller's name for the object with the radius.
[[noreturn]] inline void throw_bad_radius(const char *of, std::size_t i, Real radius, Real cutoff)
{
  char text[200];
  if (!(radius >= 0)) {
    std::snprintf(text, sizeof text, "%s %zu has radius %.9g: give 0 or more", of, i, radius);
    throw NegativeRadiusError(text);
  }
  std::snprintf(text, sizeof text,
                "%s %zu has radius %.9g, more than the grid's cutoff %.9g: build the grid with "
                "a cutoff of the largest radius",
                of, i, radius, cutoff);
  throw RadiusError(text);
}

}    // namespace lsdcd
