// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Input words of fix insert/lsdcd -> InsertSettings.
#pragma once

#include "insert/insertion.h"
#include "wall/spec/wall_spec.h"

#include <string>
#include <vector>

namespace lsdcd {

struct InsertSettings {
  MeshSpec face;         // without a file: a region
  std::string region;    // its ID
  InsertionPlan plan;
  int type = 1;                 // of atoms
  bool along_normal = false;    // of the face, with `speed`
  Real speed = 0;
  Vec3 velocity = {0, 0, 0};
  bool has_temperature = false;
  Real temperature = 0;
  bool has_shapes() const { return !plan.grains.kinds.empty() && !has_clumps(); }
  // Clumps: ID of a molecule template, whose molecules become kinds of grains, the fix that moves them, and the share of each molecule;
  // none: equal ones.
  std::string molecules, rigid;
  std::vector<Real> shares;
  bool shares_are_by_mass = false;
  bool has_clumps() const { return !molecules.empty(); }
  Real depth = 0;           // length; how far in front of the face grains are put
  bool all_walls = true;    // grains keep off these fixes, or off those named
  std::vector<std::string> walls;
};

// Throws InputError that names the word, what was expected and the syntax.
InsertSettings parse_insert(const std::vector<std::string> &tokens);

}    // namespace lsdcd
