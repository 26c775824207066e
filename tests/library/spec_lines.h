// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall is made of, a line for each member of Wall::spec(), for test_fields.py.
#pragma once

#include "lsdcd.h"

#include <exception>
#include <string>

// Members by their names, numbers with all digits: "mesh0.wear_factor = 1".
std::string spec_lines_of(const lsdcd_wall *wall);

// Returns a text that lives until the next call, "refused: " and the error where there is one.
template <class Work>
const char *told(const Work &work)
{
  static std::string text;
  try {
    text = work();
  } catch (const std::exception &e) {
    text = std::string("refused: ") + e.what();
  }
  return text.c_str();
}
