// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How messages name one of a wall's meshes, and tell that it went too far.
#pragma once

#include "base/input_words.h"
#include "motion/step_clock.h"
#include "wall/spec/wall_spec.h"

#include <string>

namespace lsdcd {

// Returns a text about a mesh, counted from 0, with its number and name if the wall has several.
inline std::string with_mesh_name(const WallSpec &wall, int mesh, const std::string &text)
{
  if (wall.meshes.size() == 1) return text;
  return "mesh " + std::to_string(mesh + 1) + " '" + wall.meshes[mesh].name + "': " + text;
}

// Returns a text about what has gone this way (length) in a step, which is more than `most`, so that a sphere may be behind it.
inline std::string passed_text(const std::string &what, Real way, const Step &step,
                               const std::string &most)
{
  return what + " has moved by " + number_text(way) + " in step " + std::to_string(step.number) +
         ", more than the largest " + most +
         ": it may have passed through a sphere; use a shorter timestep";
}

}    // namespace lsdcd
