// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A line of `lsdcd check`.
#pragma once

#include <string>

namespace lsdcd {

// absent: this machine or this build has none, which is no error.
enum class CheckState { works, absent, fails };

struct CheckLine {
  std::string name;
  CheckState state;
  std::string tried, gave;
  std::string remedy = {};    // empty where it works
};

}    // namespace lsdcd
