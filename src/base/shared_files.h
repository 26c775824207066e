// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Files that come with the program: materials, scripts.
#pragma once

#include <filesystem>

namespace lsdcd {

// Returns the folder share/lsdcd of this build or installation: the nearest one above the folder of the program or
// plugin. If there is none, the name that it would have beside this folder; empty: not known.
std::filesystem::path shared_folder();

}    // namespace lsdcd
