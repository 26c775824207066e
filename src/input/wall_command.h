// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The arguments of fix wall/lsdcd -> WallSpec. One row per keyword in keywords.cpp.
#pragma once

#include "input/material_words.h"
#include "input/program_words.h"
#include "output/mesh_image.h"
#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

// How dump image shows a wall.
struct PictureSpec {
  Draw draw = Draw::edges;
  int type = 1;        // atom type whose colour the mesh takes
  bool cut = false;    // leaves out centres with dot(cut_normal, x) > cut_offset
  Vec3 cut_normal = {0, 0, 0};
  Real cut_offset = 0;
};

struct WallCommand {
  WallSpec wall;
  PictureSpec picture;
  WallMaterials materials;
};

// What a program says beside its words.
struct ProgramWall {
  const ProgramWords &words;    // whose values the arguments have
  bool on_device = false;       // are its spheres in arrays of a GPU, where the wall then computes?
};

// `arguments` begin with FSTYLE. Laws have their names, NULLs resolved, and stiffnesses still in pressure units.
// `laws_of`: gives those of materials, once all else is read. `program`: null for a script. Throws InputError that names the argument, what was expected
// and the syntax.
WallCommand parse_wall(const std::vector<std::string> &arguments,
                       const LawsOfMaterials &laws_of = {}, const ProgramWall *program = nullptr);

// Returns the command with every keyword, its unit, range and default; several lines.
std::string wall_help();

}    // namespace lsdcd
