// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What the contacts of a wall's meshes have done with energy since the beginning, on all processes.
#pragma once

#include "engine/results/booked_energy.h"
#include "host/host.h"
#include "motion/step_clock.h"
#include "wall/spec/wall_spec.h"
#include "wall/sums/coat_load.h"

#include <vector>

namespace lsdcd {

// Meshes are counted from 0. All is 0 where spec.energy is not set.
class EnergyBooks {
 public:
  // The host must outlive this object.
  EnergyBooks(Host &host, const WallSpec &settings);

  // Adds a step; `left`: what it left on this process, null: there are no spheres; `coats`: the same on all processes.
  void add(StepResults *left, const CoatEnergy &coats, const Step &step);

  // Return the sums over all processes, of one mesh and of all. Collective.
  BookedEnergy mesh(int k);
  BookedEnergy of_all();

  // Restores sums of a saved state, the same on all processes.
  void restore(int mesh, const BookedEnergy &was);

 private:
  void sum();

  Host &host_;
  std::vector<BookedEnergy> here_, everywhere_;    // of each mesh; on this process, and on all
  bool is_summed_ = true;
};

}    // namespace lsdcd
