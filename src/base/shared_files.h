// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files that come with the program: materials, scripts.
#pragma once

#include <filesystem>

namespace lsdcd {

// The folder share/lsdcd of the build or installation that this code is in: the nearest above the
// folder of the program or plugin. Where there is none, that beside this folder; empty if even that
// cannot be told.
std::filesystem::path shared_folder();

}    // namespace lsdcd
