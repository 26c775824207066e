// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/results/booked_energy.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

void BookedEnergy::add_step(EnergyRows now, bool is_setup, Real duration)
{
  now[EnergyRow::inserted] +=
      rows[EnergyRow::held] - now[is_setup ? EnergyRow::held : EnergyRow::seen];
  for (int row = 0; row < static_cast<int>(EnergyRow::held); row++) rows.of[row] += now.of[row];
  rows[EnergyRow::held] = now[EnergyRow::held];
  if (is_setup) return;
  step = now;
  dt = duration;
}

void BookedEnergy::add(const BookedEnergy &other)
{
  rows.add(other.rows);
  step.add(other.step);
  dt = std::max(dt, other.dt);
}

void sum_over_processes(Host &host, BookedEnergy *booked, int n)
{
  std::vector<Real> numbers;
  for (int k = 0; k < n; k++)
    for (const EnergyRows *rows : {&booked[k].rows, &booked[k].step})
      numbers.insert(numbers.end(), rows->of, rows->of + kEnergyRows);
  host.sum(numbers.data(), static_cast<int>(numbers.size()));
  const Real *next = numbers.data();
  for (int k = 0; k < n; k++)
    for (EnergyRows *rows : {&booked[k].rows, &booked[k].step}) {
      std::copy(next, next + kEnergyRows, rows->of);
      next += kEnergyRows;
    }
}

Real BookedEnergy::lost() const
{
  Real lost = 0;
  for (int row = static_cast<int>(EnergyRow::damping); row < static_cast<int>(EnergyRow::held);
       row++)
    lost += rows.of[row];
  return lost;
}

}    // namespace lsdcd
