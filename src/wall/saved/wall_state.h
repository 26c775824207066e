// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a wall for a saved state, beside the springs of spheres.
#pragma once

#include "base/state_blocks.h"
#include "wall/saved/mesh_state.h"

#include <string>
#include <vector>

namespace lsdcd {

struct WallState {
  Real history_kind = 0;    // of the springs in the file: ContactLaw::history_kind()
  Time time = 0;            // of the spheres
  int average_every = 0;    // steps of the means; 0: there are none
  std::vector<MeshState> meshes;
  std::string unread;    // blocks of a later version, which are not here; empty: none

  State blocks() const;
  // Throws StateError.
  static WallState from(const State &state);

  static const char *const kKind;    // of State
};

}    // namespace lsdcd
