// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The facts of a mesh as JSON, and what is wrong with it.
#pragma once

#include "mesh/welded_mesh.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>
#include <vector>

namespace lsdcd {

// Writes it, and the end of a line. What is no UTF-8, as a name or a text of a file may be, becomes U+FFFD.
void print_json(std::FILE *to, const nlohmann::json &all);

nlohmann::json as_json(const Vec3 &v);
nlohmann::json as_json(const MeshReport &report);

// Faults of a mesh; empty: it is clean. An open mesh may be clean: many walls are open.
std::vector<std::string> problems_of(const MeshReport &report);

// Returns a line below describe(): "  clean       yes", or no and why not.
std::string verdict_line(const MeshReport &report);

}    // namespace lsdcd
