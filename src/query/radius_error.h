// A sphere that the grid's lists were not built for.
#pragma once

#include "base/input_error.h"
#include "base/real.h"

#include <cstddef>
#include <cstdio>

namespace lsdcd {

struct RadiusError : InputError {
  using InputError::InputError;
};

[[noreturn]] inline void throw_too_large(std::size_t i, Real radius, Real cutoff)
{
  char text[200];
  std::snprintf(text, sizeof text,
                "sphere %zu has radius %.9g, more than the grid's cutoff %.9g: build the grid with "
                "a cutoff of the largest radius, or try every face",
                i, radius, cutoff);
  throw RadiusError(text);
}

}    // namespace lsdcd
