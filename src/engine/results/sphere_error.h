// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An error of one sphere, which an engine knows by its index in the arrays only.
#pragma once

#include "base/input_error.h"
#include "base/real.h"
#include "host/remedy.h"

#include <cstdio>
#include <optional>
#include <string>

namespace lsdcd {

// A host that knows the sphere by a name puts that before the problem.
struct SphereError : InputError {
  SphereError(int i, const std::string &what_of_it, std::optional<Remedy> way_out = {}) :
      InputError("sphere " + std::to_string(i) + " " + what_of_it +
                 (way_out ? "; " + library_remedy(*way_out) : "")),
      sphere(i), problem(what_of_it), remedy(way_out)
  {
  }
  int sphere;
  std::string problem;
  std::optional<Remedy> remedy;    // where the host names the way out
};

[[noreturn]] inline void throw_too_large(int i, Real radius, Real cutoff)
{
  char text[160];
  std::snprintf(text, sizeof text,
                "has radius %.9g, more than the grid's cutoff %.9g; set rmax to the largest radius "
                "that will occur",
                radius, cutoff);
  throw SphereError(i, text);
}

[[noreturn]] inline void throw_too_many_contacts(int most)
{
  throw InputError("a sphere touches the wall in more than " + std::to_string(most) +
                   " separate places: the mesh is far finer than its overlap; use a stiffer "
                   "contact, which needs a shorter timestep, or a coarser mesh");
}

[[noreturn]] inline void throw_no_slots()
{
  throw RemedyError(
      "spheres that touch the wall in several places became so many since the spheres "
      "near the wall were selected that the memory for their springs ran out",
      Remedy::make_room);
}

[[noreturn]] inline void throw_has_grown(int i)
{
  throw SphereError(i,
                    "has grown since the spheres near the wall were selected, so that others may "
                    "have been missed",
                    Remedy::announce_growth);
}

}    // namespace lsdcd
