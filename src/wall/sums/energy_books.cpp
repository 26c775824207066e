// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/energy_books.h"

#include <cstddef>

namespace lsdcd {

EnergyBooks::EnergyBooks(Host &host, const WallSpec &settings) :
    host_(host), here_(settings.energy ? settings.meshes.size() : 0), everywhere_(here_)
{
}

void EnergyBooks::add(StepResults *left, const CoatEnergy &coats, const Step &step)
{
  if (here_.empty()) return;
  is_summed_ = false;
  if (step.kind == Step::snapshot) {
    for (BookedEnergy &m : here_) m.dt = 0;
    return;
  }
  for (std::size_t k = 0; k < here_.size(); k++) {
    EnergyRows rows = left ? left->energy(static_cast<int>(k)) : EnergyRows();
    if (!coats.rows.empty() && host_.is_first()) rows.add(coats.rows[k]);
    here_[k].add_step(rows, step.kind == Step::setup, step.dt);
  }
}

void EnergyBooks::sum()
{
  if (is_summed_) return;
  is_summed_ = true;
  everywhere_ = here_;
  sum_over_processes(host_, everywhere_.data(), static_cast<int>(everywhere_.size()));
}

BookedEnergy EnergyBooks::mesh(int k)
{
  sum();
  return everywhere_.empty() ? BookedEnergy() : everywhere_[static_cast<std::size_t>(k)];
}

BookedEnergy EnergyBooks::of_all()
{
  sum();
  BookedEnergy all;
  for (const BookedEnergy &m : everywhere_) all.add(m);
  return all;
}

void EnergyBooks::restore(int mesh, const BookedEnergy &was)
{
  if (here_.empty()) return;
  here_[static_cast<std::size_t>(mesh)] = host_.is_first() ? was : BookedEnergy();
  here_[static_cast<std::size_t>(mesh)].dt = was.dt;
  is_summed_ = false;
}

}    // namespace lsdcd
