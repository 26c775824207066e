// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of compute lsdcd/collide -> CollideSettings.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct CollideSettings {
  std::string wall;    // ID of a fix wall/lsdcd
  MeshSpec mesh;       // of the body: file, placement and weld
  std::string
      atoms_file;    // file with its atoms in the mesh's frame; empty: as the first body has them
  bool molecules = false;    // a body per molecule, not one of all atoms
  Real grid_length = 0;      // length; 0: the median edge of the body
  int nearest = 0;           // triangles a cell; 0: all
  std::size_t memory = 0;    // bytes; 0: the default
  Device device = Device::cpu;
  bool brief = false;    // one line in the log
};

// Throws InputError that names the word, what was expected and the syntax.
CollideSettings parse_collide(const std::vector<std::string> &tokens);

}    // namespace lsdcd
