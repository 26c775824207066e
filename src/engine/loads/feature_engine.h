// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Adds up rows (feature_row.h) of the features of meshes, over time and in the memory of the engine.
#pragma once

#include "engine/loads/feature_row.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Upper bounds of the numbers of features that a mesh has, without periodic images.
struct FeatureCounts {
  std::size_t faces, edges, vertices;

  std::size_t all() const { return faces + edges + vertices; }
};

template <class Row>
class FeatureEngine {
 public:
  virtual ~FeatureEngine() = default;

  // Adds the last step, of duration dt (time), on a mesh of `counts`, which are the same in each call. Does not wait.
  virtual void add(int mesh, const FeatureCounts &counts, Real dt) = 0;
  // Returns the rows of features with any sum that is not 0 since the last call, in the order of their codes, and clears them.
  // Waits.
  virtual std::vector<RowOfFeature<Row>> take(int mesh) = 0;
};

}    // namespace lsdcd
