// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Adds up, over time and in the memory of the engine, what contacts do to the features of meshes.
#pragma once

#include "base/real.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Upper bounds of the numbers of features that a mesh has, without periodic images.
struct FeatureCounts {
  std::size_t faces, edges, vertices;

  std::size_t all() const { return faces + edges + vertices; }
};

class LoadEngine {
 public:
  // Numbers of a row: the feature's code; then sums over contacts of normal force, shear, contacts and power of wear, each times the
  // duration of its step; then sums of the force on the wall times that duration, x y z (StepContact).
  static constexpr int kRow = 8;

  virtual ~LoadEngine() = default;

  // Adds the contacts of the last step, of duration dt (time), on a mesh of `counts`, which are the same in each call. Does not
  // wait.
  virtual void add(int mesh, const FeatureCounts &counts, Real dt) = 0;
  // Returns the rows of features with contacts since the last call, in the order of their codes, and clears them. Waits.
  virtual std::vector<Real> take(int mesh) = 0;
};

}    // namespace lsdcd
