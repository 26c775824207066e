// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Adds up, over time and in the memory of the engine, the energy that contacts dissipate at the features of meshes, and
// impacts.
#pragma once

#include "engine/loads/load_engine.h"
#include "engine/results/impact_bins.h"

#include <vector>

namespace lsdcd {

class EnergyEngine {
 public:
  // Numbers of a row: the feature's code, the dissipated energy, the number of impacts and their energy (sums over
  // EnergyRecord), and the greatest speed of an impact.
  static constexpr int kRow = 5;

  virtual ~EnergyEngine() = default;

  // Adds the records of the last step on a mesh of `counts`, which are the same in each call. Does not wait.
  virtual void add(int mesh, const FeatureCounts &counts) = 0;
  // Returns the rows of features that have any records since the last call, in the order of their codes, and clears them.
  // Waits.
  virtual std::vector<Real> take(int mesh) = 0;
  // Returns kImpactBins bins of the impacts since the last call, and clears them; none if no impacts are recorded. Waits.
  virtual std::vector<ImpactBin> take_bins(int mesh) = 0;
};

}    // namespace lsdcd
