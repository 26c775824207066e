// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What contacts do to the features of meshes over time, added up where the engine computes.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// At least as many as a mesh has, without periodic images.
struct FeatureCounts {
  std::size_t faces, edges, vertices;

  std::size_t all() const { return faces + edges + vertices; }
};

class LoadEngine {
 public:
  // Numbers of a row: the feature's code, then sums over contacts of normal force, shear, contacts and power of wear, each times the
  // duration of its step, and of the force on the wall times that, x y z (StepContact).
  static constexpr int kRow = 8;

  virtual ~LoadEngine() = default;

  // Adds the contacts of the last step, of duration dt (time), on a mesh of `counts`, which are always the same. Does not wait.
  virtual void add(int mesh, const FeatureCounts &counts, Real dt) = 0;
  // Returns the rows of features with contacts since the last call, in the order of their codes, and forgets them. Waits.
  virtual std::vector<Real> take(int mesh) = 0;
};

}    // namespace lsdcd
