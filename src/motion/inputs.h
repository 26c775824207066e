// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers that the host gives in each step, in place of fixed ones.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace lsdcd {

// The names of a wall's inputs, each once. A member called `input` counts from 0 in such a list.
using InputNames = std::vector<std::string>;

constexpr int kNoInput = -1;    // the number is fixed

// Returns the number of the input with this name, which is added if it is new.
inline int number_of_input(InputNames &inputs, const std::string &name)
{
  const auto number = std::find(inputs.begin(), inputs.end(), name) - inputs.begin();
  if (number == static_cast<std::ptrdiff_t>(inputs.size())) inputs.push_back(name);
  return static_cast<int>(number);
}

}    // namespace lsdcd
