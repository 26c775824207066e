// A radius that the grid's lists were not built for, or that is none.
#pragma once

#include "base/input_error.h"
#include "base/real.h"

#include <cstddef>
#include <cstdio>

namespace lsdcd {

struct RadiusError : InputError {
  using InputError::InputError;
};
// Below 0, or not a number.
struct NegativeRadiusError : InputError {
  using InputError::InputError;
};

[[noreturn]] inline void throw_bad_radius(std::size_t i, Real radius, Real cutoff)
{
  char text[200];
  if (!(radius >= 0)) {
    std::snprintf(text, sizeof text, "point %zu (from 0) has the radius %.9g: give lengths", i,
                  radius);
    throw NegativeRadiusError(text);
  }
  std::snprintf(text, sizeof text,
                "sphere %zu has radius %.9g, more than the grid's cutoff %.9g: build the grid with "
                "a cutoff of the largest radius, or try every face",
                i, radius, cutoff);
  throw RadiusError(text);
}

}    // namespace lsdcd
