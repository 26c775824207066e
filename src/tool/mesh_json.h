// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The facts of a mesh as JSON, and what is wrong with it.
#pragma once

#include "mesh/welded_mesh.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace lsdcd {

nlohmann::json as_json(const Vec3 &v);
nlohmann::json as_json(const MeshReport &report);

// Faults of a mesh; empty: it is clean. An open mesh may be clean: many walls are open.
std::vector<std::string> problems_of(const MeshReport &report);

// Returns a line below describe(): "  clean       yes", or no and why not.
std::string verdict_line(const MeshReport &report);

}    // namespace lsdcd
