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
};

}    // namespace lsdcd
