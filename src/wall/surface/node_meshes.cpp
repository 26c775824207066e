// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/surface/node_meshes.h"

#include <cstdint>

namespace lsdcd {

void give_nodes(Host &host, const std::vector<MeshNodes *> &all, WallEngine *last,
                WallEngine &engine)
{
  if (all.empty()) return;
  if (!last)
    return run_collectively(host, true, [&] {
      for (MeshNodes *nodes : all) nodes->start(engine);
    });
  engine.take_nodes(*last);
  for (MeshNodes *nodes : all) nodes->forget_grid();
}

void place_nodes(const std::vector<MeshNodes *> &all, WallEngine &engine, Real cutoff, int n)
{
  for (MeshNodes *nodes : all) {
    const bool is_grid_due = nodes->needs_grid(cutoff);
    if (is_grid_due) nodes->build_grid(cutoff);
    if (is_grid_due || nodes->needs_choice(cutoff)) engine.expire_choice();
  }
  for (MeshNodes *nodes : all) nodes->turn_springs(n);
}

void agree_on_forces(Host &host, const std::vector<MeshNodes *> &all, bool failed)
{
  if (host.processes() == 1) return;
  std::vector<Real> counts, exponents;
  for (const MeshNodes *nodes : all) {
    const SummandRange mine = failed ? SummandRange{0, kNotFinite} : nodes->range();
    counts.push_back(static_cast<Real>(mine.count));
    exponents.push_back(static_cast<Real>(mine.exponent));
  }
  const int n = static_cast<int>(all.size());
  host.sum_and_max(counts.data(), n, exponents.data(), n);
  for (int k = 0; k < n; k++) {
    if (failed)
      all[k]->have_no_forces();
    else
      all[k]->add_forces(
          {static_cast<std::uint64_t>(counts[k]), static_cast<std::uint64_t>(exponents[k])});
  }
}

}    // namespace lsdcd
