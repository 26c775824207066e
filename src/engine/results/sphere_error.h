// An error of one sphere, which an engine knows by its place in the arrays only.
#pragma once

#include "base/input_error.h"

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

}    // namespace lsdcd
