// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The version of LSDCD. CMakeLists.txt has it; nothing else in `src` but lsdcd.h says it again.
#pragma once

namespace lsdcd {

// "0.10.0".
const char *version();

}    // namespace lsdcd
