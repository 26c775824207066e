// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Is there a GPU that this build can use?
#pragma once

#include <string>

namespace lsdcd {

// True if this build has CUDA and a usable GPU is present; `why` says what is missing otherwise.
bool cuda_available(std::string *why);

}    // namespace lsdcd
