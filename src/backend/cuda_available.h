// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Is there a GPU that this build can use, and how many?
#pragma once

#include <string>

namespace lsdcd {

// True if this build has CUDA and a usable GPU is present; `why` says what is missing otherwise.
bool cuda_available(std::string *why);

// Returns how many GPUs this process sees; 0 where cuda_available() is false.
int cuda_devices();

}    // namespace lsdcd
