// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The energy balance of contacts since the beginning.
#pragma once

#include "engine/results/step_results.h"
#include "host/host.h"

namespace lsdcd {

// The causes, in the order of outputs.
constexpr EnergyRow kCauses[] = {EnergyRow::damping, EnergyRow::slider, EnergyRow::rolling,
                                 EnergyRow::twisting, EnergyRow::adhesion};
constexpr EnergyRow kOtherLosses[] = {EnergyRow::lever_arms, EnergyRow::stiffness,
                                      EnergyRow::turned_springs, EnergyRow::inserted};

// The energies of one mesh, or of all pairs. `rows`: sums over all steps, except `held`, which is the present value. The energy of
// contacts that come and go with their spheres, or change between runs, is also in `inserted`.
struct BookedEnergy {
  EnergyRows rows;
  EnergyRows step;    // of the last step
  Real dt = 0;        // duration of it (time); 0: there was no step

  // Adds a step of this process. Spheres go from process to process with what their contacts held, so that `inserted` is right only
  // for all processes together.
  void add_step(EnergyRows now, bool is_setup, Real duration);
  void add(const BookedEnergy &other);
  // Returns the power of this row in the last step, energy/time.
  Real power(EnergyRow row) const { return dt > 0 ? step[row] / dt : 0; }
  // Return what is lost by all rows, and the work that is neither held now nor lost.
  Real lost() const;
  Real remainder() const { return rows[EnergyRow::work] - rows[EnergyRow::held] - lost(); }
};

// Reads or writes the numbers of restart files.
template <class Numbers>
void each_number(Numbers &numbers, BookedEnergy &e)
{
  numbers(e.rows.of, e.step.of, e.dt);
}

// Sums n energy balances over all processes. Collective.
void sum_over_processes(Host &host, BookedEnergy *booked, int n);

}    // namespace lsdcd
