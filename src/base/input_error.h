// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The core throws this where input of the user cannot be used.
#pragma once

#include <stdexcept>
#include <string>

namespace lsdcd {

// The message names the file, line or facet, the value found, and the remedy.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
  // Says what is wrong with sphere `index` of the arrays.
  InputError(int index, const std::string &what_is_wrong) :
      std::runtime_error("sphere " + std::to_string(index) + " " + what_is_wrong), sphere(index),
      problem(what_is_wrong)
  {
  }

  int sphere = -1;          // the index of the sphere that is wrong; -1: no sphere is
  std::string problem;      // the message without the sphere
  bool is_local = false;    // only this process knows of it
};

// Throws an InputError that is local: the other processes go on until the program ends them.
[[noreturn]] inline void fail_here(const std::string &error)
{
  InputError here(error);
  here.is_local = true;
  throw here;
}

}    // namespace lsdcd
