// An error of one sphere, which an engine knows by its place in the arrays only.
#pragma once

#include "base/input_error.h"
#include "base/real.h"

#include <cstdio>
#include <string>

namespace lsdcd {

// A host that knows the sphere by a name puts that before the problem.
struct SphereError : InputError {
  SphereError(int i, const std::string &what_of_it) :
      InputError("sphere " + std::to_string(i) + " " + what_of_it), sphere(i), problem(what_of_it)
  {
  }
  int sphere;
  std::string problem;
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

[[noreturn]] inline void throw_too_many_contacts(int spheres, int most)
{
  throw InputError(std::to_string(spheres) +
                   " spheres touch the wall in more separate places than there is memory for (" +
                   std::to_string(most) + " each); the mesh is far finer than its overlap");
}

[[noreturn]] inline void throw_has_grown(int i)
{
  throw SphereError(
      i, "has grown since near spheres were chosen, so that others may have been missed; "
         "radii that something else than fix adapt changes in a run need "
         "'neigh_modify delay 0 every 1 check no'");
}

}    // namespace lsdcd
