// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The errors of steps, which an engine finds when it reads its counts.
#pragma once

#include "base/input_error.h"
#include "base/real.h"
#include "host/host_names.h"

#include <cstdio>
#include <string>

namespace lsdcd {

[[noreturn]] inline void throw_too_large(int i, Real radius, Real cutoff)
{
  char text[160];
  std::snprintf(text, sizeof text,
                "has radius %.9g, more than the grid's cutoff %.9g; set rmax to the largest radius "
                "that will occur",
                radius, cutoff);
  throw InputError(i, text);
}

[[noreturn]] inline void throw_too_many_contacts(int most)
{
  throw InputError("a sphere touches the wall in more than " + std::to_string(most) +
                   " separate places: the mesh is far finer than its overlap; use a stiffer "
                   "contact, which needs a shorter timestep, or a coarser mesh");
}

[[noreturn]] inline void throw_no_places(const HostNames &names)
{
  throw InputError(
      std::string("spheres that touch the wall in several places became so many since the spheres "
                  "near the wall were selected that the memory for their springs ran out; ") +
      names.make_room);
}

[[noreturn]] inline void throw_has_grown(int i, const HostNames &names)
{
  throw InputError(i, std::string("has grown since the spheres near the wall were selected, so "
                                  "others may have been missed; ") +
                          names.announce_growth);
}

}    // namespace lsdcd
