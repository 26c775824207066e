// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The data of a wall for a saved state, beside the springs of spheres.
#pragma once

#include "base/state_blocks.h"
#include "wall/mean_loads.h"
#include "wall/move/body_mover.h"
#include "wall/move/mesh_motion.h"
#include "wall/mesh_nodes.h"
#include "wall/mesh_wear.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsdcd {

// By which a mesh is known again: its counts, and a number made of all of it.
struct MeshIdentity {
  std::int64_t facets = 0, edges = 0, vertices = 0;
  Real fingerprint = 0;

  bool operator==(const MeshIdentity &other) const
  {
    return facets == other.facets && edges == other.edges && vertices == other.vertices &&
           fingerprint == other.fingerprint;
  }
};

// What acted on a mesh in the last step, by which servos move, and bodies where they are.
struct StepLoad {
  MeshTotals totals;
  CoatLoad coat;    // its contacts, overlap, radius and mass
};

struct LoadState {
  Real time = 0;             // of the average
  std::vector<Real> rows;    // of all processes, as of MeshLoads::packed()
};

struct MeshState {
  MeshIdentity mesh;
  MotionState motion;
  LoadState loads;
  BodyState body;
  NodeState nodes;
  std::vector<Real> coat;             // of BodyCoat::save()
  ShapeState shape;                   // of a mesh that recedes by its wear
  std::vector<MeanLoadState> mean;    // one, or none where there are no means
  std::vector<StepLoad> last;         // one; none: data without it
};

struct WallState {
  Real history_kind = 0;    // of the springs in the file: ContactLaw::history_kind()
  Time time = 0;            // of the spheres
  std::vector<MeshState> meshes;
  std::string unread;    // blocks of a later version, which are not here; empty: none

  State blocks() const;
  // Throws StateError.
  static WallState from(const State &state);

  static const char *const kKind;    // of State
};

}    // namespace lsdcd
