// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of region mesh/lsdcd -> RegionSettings.
#pragma once

#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct RegionSettings {
  MeshSpec mesh;    // file, placement and weld
  Real gap = 0;     // length; how far from the surface points must be
  // Words that LAMMPS reads for all its regions: side, units, move and rotate by variables.
  std::vector<std::string> host_words = {"units", "box"};
};

// Throws InputError that names the word, what was expected and the syntax.
RegionSettings parse_region(const std::vector<std::string> &tokens);

}    // namespace lsdcd
