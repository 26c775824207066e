// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The lines of the log on a wall that is made.
#pragma once

#include "wall/coat/body_coats.h"

#include <deque>
#include <string>

namespace lsdcd {

// Returns the lines of the log. `material`: what a material file filled in, in lines; else empty. `device`: of the engine, with the reason
// why it is no other. Called by the first process, which has the reports of the meshes.
std::string creation_text(const HostNames &names, const WallSpec &settings,
                          const std::deque<MeshPart> &meshes, const BodyCoats &coats,
                          const EngineSettings &engine, const std::string &material,
                          const std::string &device);

}    // namespace lsdcd
