// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Adds up, over time and in the memory of the engine, the energy that contacts dissipate at the features of meshes, and
// impacts.
#pragma once

#include "engine/loads/feature_engine.h"
#include "engine/loads/place_energy.h"
#include "engine/results/impact_bins.h"

#include <vector>

namespace lsdcd {

class EnergyEngine : public FeatureEngine<PlaceEnergy> {
 public:
  // Returns kImpactBins bins of the impacts since the last call, and clears them; none if no impacts are recorded. Waits.
  virtual std::vector<ImpactBin> take_bins(int mesh) = 0;
};

}    // namespace lsdcd
