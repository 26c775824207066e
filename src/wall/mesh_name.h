// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How messages name one of a wall's meshes.
#pragma once

#include "input/settings.h"

#include <string>

namespace lsdcd {

// What is said of a mesh, counted from 0, with its number and file where the wall has several.
inline std::string with_mesh_name(const WallSettings &wall, int mesh, const std::string &text)
{
  if (wall.meshes.size() == 1) return text;
  return "mesh " + std::to_string(mesh + 1) + " '" + wall.meshes[mesh].file + "': " + text;
}

}    // namespace lsdcd
