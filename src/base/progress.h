// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Long work reports how much of it is done, and a listener can end it.
#pragma once

#include <cmath>
#include <functional>
#include <string>

namespace lsdcd {

// `what` is done now, `share` of it is done, from 0 to 1. It is called by the thread that asked for the work, and
// an exception ends the work. Empty: nobody listens.
using ProgressListener = std::function<void(const std::string &what, double share)>;

inline std::string progress_text(const std::string &what, double share)
{
  return what + ", " + std::to_string(std::lround(100 * share)) + "%";
}

}    // namespace lsdcd
