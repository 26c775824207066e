// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How messages name one of a wall's meshes.
#pragma once

#include "wall/wall_spec.h"

#include <string>

namespace lsdcd {

// A text about a mesh, counted from 0, with its number and name where the wall has several.
inline std::string with_mesh_name(const WallSpec &wall, int mesh, const std::string &text)
{
  if (wall.meshes.size() == 1) return text;
  return "mesh " + std::to_string(mesh + 1) + " '" + wall.meshes[mesh].name + "': " + text;
}

}    // namespace lsdcd
