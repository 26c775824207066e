// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The wall of a script without LAMMPS, for tests of the library, whose header has a Wall, too.
#pragma once

#include "api/lsdcd.h"

#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

// Acts on spheres in arrays of a test as fix wall/lsdcd does on atoms, with one process and without a box. Lengths, times, and so on are
// those of the words.
class ScriptWall {
 public:
  // `words` follow wall/lsdcd; `units`: the script's. Throws InputError.
  explicit ScriptWall(const std::vector<std::string> &words, const std::string &units = "si");
  ~ScriptWall();

  // Adds forces and torques, and heat where the law has it.
  void step(const lsdcd_spheres &spheres, const lsdcd_wall_step &step);
  // The words of fix_modify.
  void change(const std::vector<std::string> &words);

  double worn(int mesh) const;       // volume
  double removed(int mesh) const;    // likewise, see MeshWear

 private:
  struct State;
  std::unique_ptr<State> in_;
};

}    // namespace lsdcd
